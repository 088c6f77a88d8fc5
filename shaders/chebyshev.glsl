// SPDX-License-Identifier: Apache-2.0
// What two moments of a window of depths say about a receiver.
#ifndef GNOMON_CHEBYSHEV_GLSL
#define GNOMON_CHEBYSHEV_GLSL

// Upper bound of the fraction of depths that are not nearer than t (one-tailed Chebyshev inequality; Donnelly and Lauritzen 2006,
// equation 5). Exact where the window holds two depths and t is the farther one.
float chebyshev(vec2 moments, float t, float min_variance)
{
    const float d = t - moments.x;
    if (d <= 0.0) return 1.0;
    const float variance = max(moments.y - moments.x * moments.x, min_variance);
    return variance / (variance + d * d);
}

// Cuts off the faint end of the bound, where light bleeds through several occluders (Lauritzen 2007).
float reduce_bleeding(float p, float amount) { return clamp((p - amount) / max(1.0 - amount, 1e-6), 0.0, 1.0); }

#endif
