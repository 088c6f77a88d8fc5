// SPDX-License-Identifier: Apache-2.0
// The two steps of percentage-closer soft shadows, each from moments. Include before the functions that read the summed-area table, and
// define Sums.
#ifndef GNOMON_MOMENT_SOFT_RESOLVE_GLSL
#define GNOMON_MOMENT_SOFT_RESOLVE_GLSL
#include "shaders/chebyshev.glsl"
#include "shaders/prefiltered_soft.glsl"

layout(constant_id = 0) const int grid = 3;

#include "techniques/moment_soft/moment_soft_kernel.glsl"

// The steepest receiver that `tilt` clears, metres of depth a metre: farther out it would stand before its blockers, and light gets into
// closed boxes.
const float tilt_limit = 16.0;

KernelSettings kernel_settings(bool centred)
{
    const float cleared = min(tilt_limit / max(length(point.slope / point.texel), 1e-20), 1.0);
    const vec2 tilt = c.params.tilt * cleared / half_range * abs(point.slope);
    return KernelSettings(1e-6 * c.params.moment_bias, 2.0 * c.params.depth_bias, tilt, centred);
}

vec2 mean_blocker(vec2 lo, vec2 hi)
{
    const Evidence e = weigh_kernel(kernel_settings(c.params.centred != 0), lo, hi);
    return vec2(e.blocked.x / e.area, e.blocked.x > 0.0 ? e.blocked.y / e.blocked.x : 0.0);
}

float lit_part(vec2 lo, vec2 hi)
{
    const Evidence e = weigh_kernel(kernel_settings(false), lo, hi);
    return reduce_bleeding(1.0 - min(e.blocked.x / e.area, 1.0), c.params.bleed_reduction);
}

#endif
