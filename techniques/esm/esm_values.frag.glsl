// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/esm/esm.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec2 value; // exp(c t / 2) or its logarithm

void main()
{
    const float exponent = 0.5 * c.params.exponent * centred_depth(c.map, ivec2(gl_FragCoord.xy));
    value = vec2(c.params.space == 0 ? exp(exponent) : exponent);
}
