// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/n_buffer.shared.h"

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray smaller;
layout(set = 1, binding = 0, scalar) uniform Constants { NBufferConstants c; }; // near is 0
layout(location = 0) out vec4 mean;

void main()
{
    // Windows clipped by the rim count by the texels that they have.
    const ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(smaller, 0).xy;
    const vec2 here = vec2(min(size - at, c.far)), beyond = vec2(clamp(size - at - c.far, ivec2(0), ivec2(c.far)));
    const vec2 f = beyond / (here + beyond);
    const ivec2 b = min(at + c.far, size - 1);
    const vec4 top = mix(texelFetch(smaller, ivec3(at, layer), 0), texelFetch(smaller, ivec3(b.x, at.y, layer), 0), f.x);
    const vec4 bottom = mix(texelFetch(smaller, ivec3(at.x, b.y, layer), 0), texelFetch(smaller, ivec3(b, layer), 0), f.x);
    mean = mix(top, bottom, f.y);
}
