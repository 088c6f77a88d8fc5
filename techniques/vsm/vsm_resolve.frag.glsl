// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/vsm/vsm.shared.h"

#include "shaders/chebyshev.glsl"
#include "shaders/filter_resolve.glsl"

void main()
{
    FilterPoint at;
    if (!find_filter_point(at)) return;
    const float deviation = 2.0 * c.params.min_deviation; // the centred range is two wide
    visibility = reduce_bleeding(chebyshev(window_mean(at, 0).xy, at.t, deviation * deviation), c.params.bleed_reduction);
}
