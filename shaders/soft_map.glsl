// SPDX-License-Identifier: Apache-2.0
// What soft shadow methods that look at one light map share: where a receiver stands in it, and how wide the light is there. Include the
// technique's shared header first: its ResolveConstants holds a SoftResolve named `soft`.
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

// False where the map has no say: `visibility` is then written.
bool find_soft_point(out SoftPoint p)
{
    p.receiver = load_receiver(c.soft.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = SOFT_VISIBILITY(1.0);
    if (p.receiver.background) return false;
    visibility = SOFT_VISIBILITY(0.0);
    const vec3 p_world = p.receiver.p_world, n = p.receiver.n_geometric;
    p.horizon = light_reaches(c.soft.light, p_world) ? light_above_horizon(c.soft.light, p_world, n) : 0.0;
    if (p.horizon <= 0.0) return false;
    p.layer = select_layer(c.soft.map.layout_kind, c.soft.map.centre, c.soft.map.axes, c.soft.map.splits, p_world);
    const LightMapLayer layer = layer_at(c.soft.map.layers[p.layer], p_world);
    const MapPoint m = project(layer, p_world);
    p.at = m.uv * c.soft.map.size;
    p.texel = m.texel;
    p.slope = receiver_slope(layer, p_world, n) * (-1.0 / (stored_per_metre(layer, m.depth) * c.soft.map.size));
    // where the light grazes, a receiver's plane leaves the map within a texel: no steeper than 50 metres a metre
    p.slope *= min(1.0, 50.0 / max(length(p.slope / m.texel), 1e-20));
    const float rounding = 4e-6 * m.z / stored_per_metre(layer, m.depth);
    p.depth = m.depth - rounding - c.soft.params.bias * (abs(p.slope.x) + abs(p.slope.y));
    p.light = light_half_size(layer, c.soft.light, p_world);
    return true;
}

#endif
