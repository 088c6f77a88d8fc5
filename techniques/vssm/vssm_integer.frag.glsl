// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vssm/vssm.shared.h"

#include "shaders/soft_map.glsl"
#include "shaders/summed_area_table.glsl"

layout(set = 0, binding = 4) uniform usampler2DArray sums_image;

vec2 stored_moments(int layer, vec2 lo, vec2 hi)
{
    const vec2 m = window_mean(sums_image, layer, lo, hi, c.sum_step).xy;
    return vec2(2.0 * m.x - 1.0, m.y);
}

#include "techniques/vssm/vssm_resolve.glsl"
