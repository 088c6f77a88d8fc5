// SPDX-License-Identifier: Apache-2.0
// What soft shadow methods that look at one light map share: where a receiver stands in it, and how wide the light is there. Their resolve
// shaders add the function declared below. Include the technique's shared header first: its ResolveConstants begins with a SoftResolve
// named `soft`.
#ifndef GNOMON_SOFT_MAP_GLSL
#define GNOMON_SOFT_MAP_GLSL
#include "shaders/light_horizon.glsl"
#include "shaders/receiver.glsl"
#include "shaders/receiver_plane.glsl"
#include "shaders/soft_map.shared.h"
#include "shaders/soft_window.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

#ifndef SOFT_VISIBILITY
#define SOFT_VISIBILITY float // vec4 where the technique writes colours
#endif
layout(location = 0) out SOFT_VISIBILITY visibility;

struct SoftPoint {
    int layer; // of the map
    vec2 at; // texels, continuous
    float depth; // metres along the layer's axis, moved towards the light by the bias
    vec2 slope; // metres of depth that the receiver's plane gains from texel to texel
    vec2 texel; // metres, across the layer's axis, that a texel's width takes here
    vec2 light; // light_half_size
    float horizon; // fraction of the light above the receiver's plane
    Receiver receiver;
};

// For people to look at (shadow::Inspection): the output is the penumbra's estimated width instead, -1 where there is no estimate.
layout(constant_id = 31) const bool inspect_penumbra = false;
float penumbra = -1.0; // metres on a plane through the receiver across the layer's axis

// The filter's window, half of it in texels. The light's image through a point at the blockers' depth is as wide on the receiver's side as
// the window is in the map: both are the pyramid's cut there, seen from the light's centre.
void estimate_penumbra(SoftPoint p, vec2 half_width)
{
    penumbra = 2.0 * max(half_width.x * p.texel.x, half_width.y * p.texel.y);
}

// The technique's, of one layer.
SOFT_VISIBILITY soft_visibility(SoftPoint p);

SoftPoint soft_point(Receiver r, float horizon, int index)
{
    SoftPoint p;
    p.receiver = r;
    p.horizon = horizon;
    p.layer = index;
    const LightMapLayer layer = layer_at(c.soft.map.layers[p.layer], r.p_world);
    const MapPoint m = project(layer, r.p_world);
    p.at = m.uv * c.soft.map.size;
    p.texel = m.texel;
    p.slope = receiver_slope(layer, r.p_world, r.n_geometric) * (-1.0 / (stored_per_metre(layer, m.depth) * c.soft.map.size));
    // where the light grazes, a receiver's plane leaves the map within a texel: no steeper than 50 metres a metre
    p.slope *= min(1.0, 50.0 / max(length(p.slope / m.texel), 1e-20));
    const float rounding = stored_rounding(layer, m.z) / stored_per_metre(layer, m.depth);
    p.depth = m.depth - rounding - c.soft.params.bias * (abs(p.slope.x) + abs(p.slope.y));
    p.light = light_half_size(layer, c.soft.light, r.p_world);
    return p;
}

void main()
{
    const Receiver r = load_receiver(c.soft.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = SOFT_VISIBILITY(inspect_penumbra ? -1.0 : 1.0);
    if (r.background) return;
    if (!inspect_penumbra) visibility = SOFT_VISIBILITY(0.0);
    const float horizon = light_reaches(c.soft.light, r.p_world) ? light_above_horizon(c.soft.light, r.p_world, r.n_geometric) : 0.0;
    if (horizon <= 0.0) return;
    const Layers layers
        = select_layers(c.soft.map.layout_kind, c.soft.map.centre, c.soft.map.axes, c.soft.map.splits, c.soft.map.bands, r.p_world);
    for (int i = 0; i < count_of(layers); ++i)
        visibility += share_of(layers, i) * soft_visibility(soft_point(r, horizon, layers.first + i));
    if (inspect_penumbra) visibility = SOFT_VISIBILITY(penumbra);
}

#endif
