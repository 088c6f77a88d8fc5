// SPDX-License-Identifier: Apache-2.0
// What soft shadow methods that look at one light map share: where a receiver stands in it, and how wide the light is there. Include the
// technique's shared header first: its ResolveConstants holds a SoftResolve named `soft`.
#ifndef GNOMON_SOFT_MAP_GLSL
#define GNOMON_SOFT_MAP_GLSL
#include "shaders/light.glsl"
#include "shaders/light_horizon.glsl"
#include "shaders/light_map.glsl"
#include "shaders/receiver.glsl"
#include "shaders/receiver_plane.glsl"
#include "shaders/soft_map.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(location = 0) out float visibility;

struct SoftPoint {
    int layer; // of the map
    vec2 at; // texels, continuous
    float depth; // metres along the layer's axis, moved towards the light by the bias
    vec2 slope; // metres of depth that the receiver's plane gains from texel to texel
    vec2 light; // half the light's width along the map's axes: metres, or for orthographic layers the tangent of half the angle
    float horizon; // fraction of the light above the receiver's plane
    Receiver receiver;
};

// Half the light's extent along a unit vector.
float light_half_width(Light light, vec3 along)
{
    if (light.kind == LIGHT_DIRECTIONAL) return tan(light.radius);
    if (light.kind == LIGHT_RECT) return abs(dot(light.half_u, along)) + abs(dot(light.half_v, along));
    if (light.kind == LIGHT_DISK) return light.radius * sqrt(max(0.0, 1.0 - dot(light.direction, along) * dot(light.direction, along)));
    return light.radius;
}

// Half the width, in texels, of what the pyramid over the light with its apex at the receiver's depth d cuts out at depth z: the search
// window (z: the nearest depth in question) and the filter's (z: the blockers'). With l the light's half width, the pyramid is
// l (d - z) / d wide there, which from the light's centre is a tangent of l (d - z) / (d z) (Fernando 2005, "Percentage-closer soft
// shadows"); under a sun of angular radius a it is (d - z) tan(a).
vec2 window_half_width(LightMapLayer layer, vec2 light, float d, float z)
{
    const float between = max(d - z, 0.0);
    if (layer.perspective == 0) return light * (between / layer.texel_metres);
    return light * (between / (max(z, layer.near) * max(d, layer.near) * layer.texel_metres));
}

// False where the map has no say: `visibility` is then written.
bool find_soft_point(out SoftPoint p)
{
    p.receiver = load_receiver(c.soft.view, depth_image, normal_image, gl_FragCoord.xy);
    visibility = 1.0;
    if (p.receiver.background) return false;
    visibility = 0.0;
    const vec3 p_world = p.receiver.p_world, n = p.receiver.n_geometric;
    p.horizon = light_reaches(c.soft.light, p_world) ? light_above_horizon(c.soft.light, p_world, n) : 0.0;
    if (p.horizon <= 0.0) return false;
    p.layer = select_layer(c.soft.map.layout_kind, c.soft.map.centre, c.soft.map.axes, p_world);
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    const MapPoint m = project(layer, p_world);
    p.at = m.uv * c.soft.map.size;
    p.slope = receiver_slope(layer, p_world, n) * (-1.0 / (stored_per_metre(layer, m.depth) * c.soft.map.size));
    // where the light grazes, a receiver's plane leaves the map within a texel: no steeper than 50 metres a metre
    p.slope *= min(1.0, 50.0 * metres_per_texel(layer, m.depth) / max(length(p.slope), 1e-20));
    const float rounding = 4e-6 * m.z / stored_per_metre(layer, m.depth);
    p.depth = m.depth - rounding - c.soft.params.bias * (abs(p.slope.x) + abs(p.slope.y));
    // the map's axes in the world: rows of the projection, without the part of perspective that centres it
    const vec3 axis = layer.depth_plane.xyz;
    const float centring = layer.perspective != 0 ? 0.5 : 0.0;
    for (int k = 0; k < 2; ++k) {
        const vec3 row = vec3(layer.map_from_world[0][k], layer.map_from_world[1][k], layer.map_from_world[2][k]) - centring * axis;
        p.light[k] = light_half_width(c.soft.light, normalize(row));
    }
    return true;
}

#endif
