// SPDX-License-Identifier: Apache-2.0
// The two steps of percentage-closer soft shadows, each from moments. Include before window_moments(lo, hi), which reads the summed-area
// table.
#ifndef GNOMON_VSSM_RESOLVE_GLSL
#define GNOMON_VSSM_RESOLVE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/prefiltered_soft.glsl"
layout(constant_id = 0) const int search_subdivision = SUBDIVIDE_UNIFORM;
layout(constant_id = 1) const int filter_subdivision = SUBDIVIDE_ADAPTIVE;
layout(constant_id = 2) const bool per_cell = true;
layout(constant_id = 3) const int grid = 5;

#include "techniques/vssm/vssm_kernel.glsl"

KernelSettings kernel_settings(bool centred)
{
    const float flat_deviation = 2.0 * c.params.flat_deviation, min_deviation = 2.0 * c.params.min_deviation;
    return KernelSettings(flat_deviation * flat_deviation, min_deviation * min_deviation, point.slope / half_range,
        c.params.height, per_cell, centred);
}

vec2 mean_blocker(vec2 lo, vec2 hi)
{
    const KernelSettings k = kernel_settings(c.params.centred != 0);
    return kernel_blocker(weigh_kernel(k, lo, hi, search_subdivision), k);
}

float lit_part(vec2 lo, vec2 hi)
{
    const KernelSettings k = kernel_settings(false);
    return kernel_visibility(weigh_kernel(k, lo, hi, filter_subdivision), k, c.params.bleed_reduction);
}

#endif
