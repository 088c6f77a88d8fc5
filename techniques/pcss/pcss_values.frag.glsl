// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { FilterValues map; };
layout(location = 0) out vec2 moments;

void main()
{
    const float t = centred_depth(map, ivec2(gl_FragCoord.xy));
    moments = stored_values(map, vec4(t, t * t, 0.0, 0.0)).xy;
}
