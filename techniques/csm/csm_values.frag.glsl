// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/csm/csm.shared.h"
#include "techniques/csm/csm.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 values[8];

void main()
{
    const float phase = phase_of(centred_depth(c.map, ivec2(gl_FragCoord.xy)));
    for (int i = 0; i < 8; ++i) values[i] = stored_values(c.map, 0.5 + 0.5 * sines(phase, i));
}
