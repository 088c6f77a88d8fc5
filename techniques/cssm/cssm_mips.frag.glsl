// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/cssm/cssm.shared.h"

#define SAMPLER sampler2DArray
#include "shaders/anisotropic.glsl"
#include "techniques/cssm/cssm_resolve.glsl"

// One trilinear fetch, or several where the window is longer one way than the other. A bilinear fetch of texels of side s blends boxes over a
// variance of s^2 / 12 + s^2 / 6 (a texel's own, and f (1 - f) s^2 over all places f): that of a box sqrt(3) s wide.
vec4 window_value(sampler2DArray values, int layer, vec2 lo, vec2 hi)
{
    const vec2 texel = 1.0 / vec2(textureSize(values, 0).xy), width = inversesqrt(3.0) * (hi - lo) * texel;
    return anisotropic_mean(values, layer, 0.5 * (lo + hi) * texel, vec2(width.x, 0.0), vec2(0.0, width.y), 8);
}
