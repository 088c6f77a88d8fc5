// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/esm/esm.glsl"
#include "techniques/esm/esm.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec2 value; // twice: the second is for maxima

void main()
{
    value = vec2(esm_value(centred_depth(c.map, ivec2(gl_FragCoord.xy)), c.params.exponent, c.params.space == 1));
}
