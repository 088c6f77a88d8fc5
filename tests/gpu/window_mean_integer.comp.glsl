// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/summed_area_table.glsl"
#include "tests/gpu/windows.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { WindowCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { IntegerSums results[]; };
layout(set = 0, binding = 2) uniform usampler2DArray sums;
layout(set = 1, binding = 0, scalar) uniform Constants { float step_value; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= cases.length()) return;
    const WindowCase c = cases[i];
    const vec2 size = vec2(textureSize(sums, 0).xy - 1);
    const ivec2 lo = ivec2(clamp(floor(c.lo), vec2(0.0), size)), hi = ivec2(clamp(floor(c.hi), vec2(0.0), size));
    results[i] = IntegerSums(window_sum(sums, c.layer, lo, hi), window_mean(sums, c.layer, c.lo, c.hi, step_value));
}
