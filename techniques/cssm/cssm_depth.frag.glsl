// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"
#include "techniques/cssm/cssm.shared.h"
#include "techniques/cssm/cssm_depth.glsl"

layout(set = 0, binding = 1) uniform sampler2DArray pyramid_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ValuesConstants c; };
layout(location = 0) out float value;

void main()
{
    const LightMapLayer layer = c.map.layer;
    const float first = first_depth(layer, pyramid_image, c.map.index, c.tight != 0);
    value = 0.5 + 0.5 * wave_depth(layer, first, depth_from_stored(layer, fetch_depth(depth_map, c.map.index, ivec2(gl_FragCoord.xy))));
}
