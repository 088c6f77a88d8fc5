// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/evsm/evsm.shared.h"

#include "shaders/filter_resolve.glsl"
#include "techniques/evsm/evsm.glsl"

float filtered_visibility(FilterPoint at)
{
    const float deviation = 2.0 * c.params.min_deviation; // the centred range is two wide
    const vec4 moments = window_mean(at, 0);
    return reduce_bleeding(
        evsm_visibility(moments, at.t, c.params.exponent, c.params.negative_exponent, deviation, c.params.components == 1), c.params.bleed_reduction);
}
