// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/msm/msm.shared.h"

#include "shaders/filter_resolve.glsl"
#include "shaders/chebyshev.glsl"
#include "shaders/moments.glsl"

float filtered_visibility(FilterPoint at)
{
    const vec4 means = window_mean(at, 0);
    const vec4 b = c.params.format == 0 ? means : moments_from_quantised(means);
    const float bias = 1e-6 * (c.params.format == 0 ? c.params.moment_bias : max(c.params.moment_bias, 60.0));
    return reduce_bleeding(msm_visibility(b, at.t, bias), c.params.bleed_reduction);
}
