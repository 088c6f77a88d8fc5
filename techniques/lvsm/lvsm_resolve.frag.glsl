// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/lvsm/lvsm.shared.h"

#include "shaders/filter_resolve.glsl"
#include "techniques/lvsm/lvsm.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer Bounds { float bounds[]; };

float filtered_visibility(FilterPoint at)
{
    int layer = 0;
    while (layer + 1 < c.params.layers && at.t >= bounds[layer + 1]) ++layer;
    const float deviation = 2.0 * c.params.min_deviation; // the centred range is two wide
    const vec4 pair = window_mean(at, layer / 2);
    const float p = layer_visibility(layer % 2 == 0 ? pair.xy : pair.zw, at.t, bounds[layer], bounds[layer + 1], c.params.overlap, deviation);
    return reduce_bleeding(p, c.params.bleed_reduction);
}
