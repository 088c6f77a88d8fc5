// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "tests/gpu/twins.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { LightCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { LightResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const LightCase c = cases[i];
    results[i].point = light_point(c.light, c.p_world, c.u);
    results[i].towards = to_light(c.light, c.p_world);
    results[i].reaches = light_reaches(c.light, c.p_world) ? 1 : 0;
}
