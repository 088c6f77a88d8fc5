// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "shaders/moments.glsl"
#include "shaders/random.glsl"
#include "techniques/moment_soft/moment_soft.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 moments;

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const float z = centred_depth(c.map, texel);
    moments = vec4(z, z * z, z * z * z, z * z * z * z);
    if (c.map.prefilter != PREFILTER_SUMS) return;
    // Integers round: on a level plane always the same way, which a window's mean would keep. Random rounding averages out.
    const vec4 noise = vec4(random2(uvec3(texel, 2u * c.map.index)), random2(uvec3(texel, 2u * c.map.index + 1u)));
    moments = quantised_from_moments(moments) + c.dither * (noise - 0.5);
}
