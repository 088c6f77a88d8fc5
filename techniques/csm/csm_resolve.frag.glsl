// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/csm/csm.shared.h"

#include "shaders/chebyshev.glsl"
#include "shaders/filter_resolve.glsl"
#include "techniques/csm/csm.glsl"

float filtered_visibility(FilterPoint at)
{
    // E[sin], E[cos] of two terms a group
    const int groups = (c.params.terms + 1) / 2;
    const float phase = phase_of(at.t - 2.0 * c.params.offset);
    float sum = 0.0;
    for (int i = 0; i < groups; ++i)
        sum += fourier_step(2.0 * window_mean(at, i) - 1.0, phase, i, damping(i, 1.0 / float(2 * groups), c.params.attenuation));
    return reduce_bleeding(min(c.params.scale * (0.5 + sum), 1.0), c.params.bleed_reduction);
}
