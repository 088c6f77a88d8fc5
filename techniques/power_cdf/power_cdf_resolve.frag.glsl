// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/power_cdf/power_cdf.shared.h"

#include "shaders/filter_resolve.glsl"
#include "shaders/chebyshev.glsl"
#include "techniques/power_cdf/power_cdf.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray range_image;

float filtered_visibility(FilterPoint at)
{
    const vec2 z = window_range(range_image, at);
    return reduce_bleeding(power_visibility(window_mean(at, 0).x, z.x, z.y, at.t, c.params.inset), c.params.bleed_reduction);
}
