// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/evsm/evsm.shared.h"
#include "techniques/evsm/evsm.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 moments;

void main()
{
    const float t = centred_depth(c.map, ivec2(gl_FragCoord.xy));
    const vec2 w = exponential_warps(t, c.params.exponent, c.params.negative_exponent);
    moments = vec4(w.x, w.x * w.x, w.y, w.y * w.y);
}
