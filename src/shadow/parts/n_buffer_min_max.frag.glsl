// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/windows.glsl"
#include "src/shadow/parts/n_buffer.shared.h"

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray smaller;
layout(set = 1, binding = 0, scalar) uniform Constants { NBufferConstants c; };
layout(location = 0) out vec2 min_max;

void main()
{
    // A window clipped by the rim lies within the one at the rim's own texel, and that one within the window to be made.
    const ivec2 at = ivec2(gl_FragCoord.xy), rim = textureSize(smaller, 0).xy - 1;
    const ivec2 a = clamp(at + c.near, ivec2(0), rim), b = clamp(at + c.far, ivec2(0), rim);
    const vec2 top = join_min_max(texelFetch(smaller, ivec3(a, layer), 0).xy, texelFetch(smaller, ivec3(b.x, a.y, layer), 0).xy);
    const vec2 bottom = join_min_max(texelFetch(smaller, ivec3(a.x, b.y, layer), 0).xy, texelFetch(smaller, ivec3(b, layer), 0).xy);
    min_max = join_min_max(top, bottom);
}
