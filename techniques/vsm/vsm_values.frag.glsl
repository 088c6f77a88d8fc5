// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/vsm/vsm.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec2 moments;

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const float t = centred_depth(c.map, texel);
    moments = vec2(t, t * t);
    if (c.params.slope_moment == 0) return;
    // A texel as a patch of a plane: with a standard deviation of half a texel, E[x^2] = 1/4 (Lauritzen 2007).
    const vec2 slope = centred_slope(c.map, texel);
    moments.y += 0.25 * dot(slope, slope);
}
