// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/gaussian.shared.h"

// One axis of a separable weighted window. Windows that reach over the image's rim repeat its last texel.
layout(set = 0, binding = 0) uniform sampler2DArray from;
layout(set = 1, binding = 0, scalar) uniform Constants { GaussianConstants c; };

layout(location = 0) out vec4 result;

void main()
{
    const ivec2 last = textureSize(from, 0).xy - 1;
    const ivec2 along = c.axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
    const ivec2 first = ivec2(gl_FragCoord.xy) - (c.width / 2) * along;
    result = vec4(0.0);
    for (int i = 0; i < c.width; ++i) result += c.weights[i] * texelFetch(from, ivec3(clamp(first + i * along, ivec2(0), last), c.layer), 0);
}
