// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_EVSM_GLSL
#define GNOMON_EVSM_GLSL
#include "shaders/chebyshev.glsl"

// exp(c t / 2) and -exp(-c t / 2), both increasing in the centred depth t. Half the exponent to either side of zero is what lets a
// format hold twice the exponent that it could over [0, 1].
vec2 exponential_warps(float t, float exponent, float negative_exponent)
{
    return vec2(exp(0.5 * exponent * t), -exp(-0.5 * negative_exponent * t));
}

// The smaller of the bounds from both warps (Lauritzen and McCool 2008, section 6). A deviation of the depth becomes one of the warped
// depth by the warp's derivative.
float evsm_visibility(vec4 moments, float t, float exponent, float negative_exponent, float min_deviation, bool both)
{
    const vec2 w = exponential_warps(t, exponent, negative_exponent);
    const vec2 deviation = 0.5 * vec2(exponent, negative_exponent) * w * min_deviation;
    const float p = chebyshev(moments.xy, w.x, deviation.x * deviation.x);
    return both ? min(p, chebyshev(moments.zw, w.y, deviation.y * deviation.y)) : p;
}

#endif
