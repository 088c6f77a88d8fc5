// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vssm/vssm.shared.h"

#include "shaders/summed_area_table.glsl"
#include "techniques/vssm/vssm_resolve.glsl"

layout(set = 0, binding = 4) uniform usampler2DArray sums_image;

vec2 window_moments(vec2 lo, vec2 hi)
{
    const vec2 m = window_mean(sums_image, point.layer, lo, hi, c.prefiltered.sum_step).xy;
    return vec2(2.0 * m.x - 1.0, m.y);
}
