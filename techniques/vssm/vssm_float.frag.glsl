// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vssm/vssm.shared.h"

#include "shaders/summed_area_table.glsl"
#include "techniques/vssm/vssm_resolve.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray sums_image;

vec2 window_moments(vec2 lo, vec2 hi)
{
    return window_mean(sums_image, point.layer, lo, hi).xy;
}
