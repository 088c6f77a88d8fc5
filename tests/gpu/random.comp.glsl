// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/random.glsl"
#include "tests/gpu/twins.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { uvec3 cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { RandomResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    results[i] = RandomResult(hash3(cases[i]), random2(cases[i]));
}
