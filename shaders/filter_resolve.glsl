// SPDX-License-Identifier: Apache-2.0
// Where a receiver stands in a prefiltered map, and the mean of the window around it: what the resolve shader of a prefiltered map begins
// with. Include the technique's shared header first: its ResolveConstants holds a FilterResolve named `filtering`.
#ifndef GNOMON_FILTER_RESOLVE_GLSL
#define GNOMON_FILTER_RESOLVE_GLSL
#include "shaders/filter.shared.h"
#include "shaders/light.glsl"
#include "shaders/light_map.glsl"
#include "shaders/receiver.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray means_image; // of the values, one window a texel
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(location = 0) out float visibility;

struct FilterPoint {
    int layer; // of the map
    vec2 uv;
    float t; // centred depth (filter_values.glsl) of the receiver, moved towards the light by its bias
    float slope; // change of t from one texel to the next, along the receiver's steepest direction
};

// False where the map has no say: `visibility` is then written.
bool find_filter_point(out FilterPoint at)
{
    const Receiver r = load_receiver(c.filtering.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = 1.0;
    if (r.background) return false;
    visibility = 0.0;
    if (!faces_light(c.filtering.light, r.p_world, r.n_geometric) || !light_reaches(c.filtering.light, r.p_world)) return false;
    at.layer = select_layer(c.filtering.map.layout_kind, c.filtering.map.centre, r.p_world);
    const LightMapLayer layer = c.filtering.map.layers[at.layer];
    const MapPoint m = project(layer, r.p_world);
    const float slope = depth_per_texel(layer, c.filtering.map.centre, r.p_world, r.n_geometric);
    at.uv = m.uv;
    at.t = centred_from_depth(layer, m.depth - c.filtering.params.bias * slope);
    at.slope = 2.0 * slope / (layer.far - layer.near);
    return true;
}

// The mean of the values of one group over the receiver's window. Between texels the windows' means are blended, which makes the window
// one of n + 1 texels with the fractions as the outer weights, as for overlapping bilinear taps.
vec4 window_mean(FilterPoint at, int group)
{
    const vec2 uv = at.uv + c.filtering.shift / c.filtering.map.size;
    return textureLod(means_image, vec3(uv, float(at.layer * c.filtering.groups + group)), 0.0);
}

#endif
