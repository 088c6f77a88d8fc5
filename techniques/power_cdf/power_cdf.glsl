// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_POWER_CDF_GLSL
#define GNOMON_POWER_CDF_GLSL

// 1 - F(t) where F = ((z - nearest) / (farthest - nearest))^p, the power function on the window's range whose mean, p / (p + 1), is the
// window's (after Gumbau et al. 2011).
float power_visibility(float mean, float nearest, float farthest, float t)
{
    // of depths that differ by rounding alone, a receiver on them must not be the farthest: lavapipe's interpolated depth needs 8e-6
    t -= 1e-5;
    if (t <= nearest) return 1.0;
    if (t >= farthest) return 0.0;
    const float range = farthest - nearest;
    const float m = clamp((mean - nearest) / range, 1e-4, 0.9999);
    return 1.0 - pow((t - nearest) / range, m / (1.0 - m));
}

#endif
