// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/msm/msm.shared.h"
#include "shaders/moments.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 moments;

void main()
{
    const float t = centred_depth(c.map, ivec2(gl_FragCoord.xy));
    const vec4 b = vec4(t, t * t, t * t * t, t * t * t * t);
    moments = stored_values(c.map, c.params.format == 0 ? b : quantised_from_moments(b));
}
