// SPDX-License-Identifier: Apache-2.0
// Depth to values, one texel: what a shader of parts::draw_filtered_map begins with. Depth is linear along the layer's axis, -1 at its
// near and 1 at its far plane and where nothing was drawn: centred, since moments of numbers around zero cancel less.
#ifndef GNOMON_FILTER_VALUES_GLSL
#define GNOMON_FILTER_VALUES_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter.shared.h"
#include "shaders/light_map.glsl"

layout(set = 0, binding = 0) uniform sampler2DArray depth_map;

float centred_depth(FilterValues f, ivec2 texel)
{
    return centred_from_depth(f.layer, depth_from_stored(f.layer, fetch_depth(depth_map, f.index, texel)));
}

// Change of the centred depth from one texel to the next: of the differences to both neighbours the smaller, so that an edge beside
// a surface does not tilt it.
vec2 centred_slope(FilterValues f, ivec2 texel)
{
    const ivec2 last = textureSize(depth_map, 0).xy - 1;
    const float here = centred_depth(f, texel);
    vec2 slope;
    for (int axis = 0; axis < 2; ++axis) {
        const ivec2 e = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        const float before = here - centred_depth(f, max(texel - e, ivec2(0)));
        const float after = centred_depth(f, min(texel + e, last)) - here;
        slope[axis] = abs(before) < abs(after) ? before : after;
    }
    return slope;
}

// Values in [-1, 1] as the prefilter stores them: integer sums hold [0, 1].
vec4 stored_values(FilterValues f, vec4 values) { return f.prefilter == PREFILTER_SUMS ? 0.5 + 0.5 * values : values; }

#endif
