// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/soft_window.glsl"
#include "tests/gpu/twins.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { SoftCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { SoftResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const SoftCase c = cases[i];
    const vec2 size = light_half_size(c.layer, c.light, c.p_world);
    results[i] = SoftResult(light_above_horizon(c.light, c.p_world, c.n), size, window_half_width(c.layer, size, dot(c.layer.depth_plane, vec4(c.p_world, 1.0)), c.z));
}
