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
    vec2 m = vec2(t, t * t);
    // A texel as a patch of a plane: with a standard deviation of half a texel, E[x^2] = 1/4 (Lauritzen 2007).
    const vec2 slope = c.params.slope_moment != 0 ? centred_slope(c.map, texel) : vec2(0.0);
    m.y += 0.25 * dot(slope, slope);
    moments = stored_values(c.map, m.xyxy).xy;
}
