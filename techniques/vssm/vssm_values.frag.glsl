// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "shaders/random.glsl"
#include "techniques/vssm/vssm.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec2 moments;

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy);
    const float z = centred_depth(c.map, texel);
    moments = vec2(z, z * z);
    if (c.map.prefilter != PREFILTER_SUMS) return;
    moments.x = 0.5 + 0.5 * z;
    // Integers round: on a level plane always the same way, which a window's mean would keep. Random rounding averages out.
    moments += c.dither * (random2(uvec3(texel, c.map.index)) - 0.5);
}
