// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_POWER_CDF_GLSL
#define GNOMON_POWER_CDF_GLSL

// 1 - F(t) where F = ((z - nearest) / (farthest - nearest))^p, the power function on the window's range whose mean, p / (p + 1), is the
// window's (after Gumbau et al. 2011). Of a receiver that is itself the deepest surface F, being continuous, would take all of its own
// texels for occluders and leave a black rim half a window wide around every shadow; so F is looked up `inset` of the range before it. For
// two depths 0.3 keeps the result within 0.2 of the truth.
float power_visibility(float mean, float nearest, float farthest, float t, float inset)
{
    // of depths that differ by rounding alone, a receiver on them must not be the farthest: lavapipe's interpolated depth needs 8e-6
    t -= 1e-5;
    if (t <= nearest) return 1.0;
    if (t > farthest) return 0.0;
    const float range = farthest - nearest;
    const float m = clamp((mean - nearest) / range, 1e-4, 0.9999);
    const float x = max((t - nearest) / range - inset, 0.0);
    return 1.0 - pow(x, m / (1.0 - m));
}

#endif
