// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/power_cdf/power_cdf.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec2 depth; // twice: the first for means and minima, the second for maxima

void main()
{
    depth = vec2(centred_depth(c.map, ivec2(gl_FragCoord.xy)));
}
