// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_LVSM_GLSL
#define GNOMON_LVSM_GLSL
#include "shaders/chebyshev.glsl"

// The warp of a layer between two depths (Lauritzen and McCool 2008, equation 8; the book's equation 5.16), reaching a little over
// both ends.
float layer_warp(float t, float front, float back, float overlap)
{
    const float reach = overlap * (back - front);
    return clamp((t - front + reach) / max(back - front + 2.0 * reach, 1e-9), 0.0, 1.0);
}

float layer_visibility(vec2 moments, float t, float front, float back, float overlap, float min_deviation)
{
    const float deviation = min_deviation / max((back - front) * (1.0 + 2.0 * overlap), 1e-9);
    return chebyshev(moments, layer_warp(t, front, back, overlap), deviation * deviation);
}

#endif
