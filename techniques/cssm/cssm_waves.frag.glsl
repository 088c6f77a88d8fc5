// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "shaders/fourier.glsl"
#include "techniques/cssm/cssm.shared.h"
#include "techniques/cssm/cssm_depth.glsl"

layout(set = 0, binding = 1) uniform sampler2DArray pyramid_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out vec4 values[8];

void main()
{
    const LightMapLayer layer = c.map.layer;
    const float first = first_depth(layer, pyramid_image, c.map.index, c.tight != 0);
    const float z = wave_depth(layer, first, depth_from_stored(layer, fetch_depth(depth_map, c.map.index, ivec2(gl_FragCoord.xy))));
    for (int i = 0; i < 8; ++i)
        values[i] = i < c.series.groups ? 0.5 + 0.5 * (c.times_depth != 0 ? z : 1.0) * sines(wave_phase(c.series, z), i) : vec4(0.0);
}
