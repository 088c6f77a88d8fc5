// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vsm/vsm.shared.h"

#include "shaders/chebyshev.glsl"
#include "shaders/filter_resolve.glsl"

float filtered_visibility(FilterPoint at)
{
    const float deviation = 2.0 * c.params.min_deviation; // the centred range is two wide
    return reduce_bleeding(chebyshev(window_mean(at, 0).xy, at.t, deviation * deviation), c.params.bleed_reduction);
}
