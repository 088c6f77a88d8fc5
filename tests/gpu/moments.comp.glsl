// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/moments.glsl"
#include "tests/gpu/moments.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { MomentsCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { MomentsResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= count) return;
    const MomentsCase m = cases[index];
    results[index] = MomentsResult(quantised_from_moments(m.b), moments_from_quantised(m.b), moments_before(m.b, m.t, m.bias));
}
