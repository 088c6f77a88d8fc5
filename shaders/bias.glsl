// SPDX-License-Identifier: Apache-2.0
// What a receiver compares with, by kind of bias. The kinds that act on casters (slope, second depth, the layers) are in the map already:
// parts::draw_biased_map.
#ifndef GNOMON_BIAS_GLSL
#define GNOMON_BIAS_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/bias.shared.h"
#include "shaders/receiver_plane.glsl"

// The steepest receiver that is followed, metres of depth a metre across: 88.2 degrees from facing the light.
#define BIAS_SLOPE_LIMIT 32.0
// Of a cone at scale 1, metres a metre.
#define BIAS_CONE_OPENING 1.0

bool bias_is_in_map(int kind) { return kind == BIAS_MIDPOINT || kind == BIAS_DUAL_LAYERS; }

// By how much a plane's depth differs within `radius` texels of p, both ways: metres.
float depth_within(LightMapLayer layer, float size, MapPoint m, vec3 p_world, vec3 n, float radius)
{
    const float within = radius * dot(abs(receiver_tangent(layer, size, m, p_world, n, BIAS_SLOPE_LIMIT)), m.texel);
    return within / (1.0 - min(radius * dot(abs(warp_bend(layer, size, p_world, n)), vec2(1.0)), 0.75));
}

// `radius`: texels between the receiver and the farthest centre of a texel that the filter reads. `inside` is false where no texel stands
// for the receiver.
ReceiverPlane biased_plane(
    int kind, BiasParams b, LightMapLayer layer, float size, float depth_step, Light light, vec3 p_world, vec3 n, float radius, out bool inside)
{
    vec3 p = p_world;
    MapPoint m = project(layer, p);
    if (kind == BIAS_NORMAL_OFFSET) {
        // Holbert 2011. d along the normal is d / cos(a) along the light; a plane needs radius * texel * tan(a) * sqrt(2), along the
        // window's diagonal: d is that times cos(a).
        const float cos_light = dot(n, to_light(light, p).xyz);
        p += n * (b.scale * 1.41421356 * radius * max(m.texel.x, m.texel.y) * sqrt(max(0.0, 1.0 - cos_light * cos_light)));
        m = project(layer, p);
    }
    inside = m.inside;
    float towards = bias_is_in_map(kind) ? 0.0 : b.constant;
    if (kind == BIAS_TEXEL_WORLD || kind == BIAS_IDS) towards += b.scale * depth_within(layer, size, m, p, n, radius);
    m.depth -= towards;
    if (layer.perspective != 0) m.depth = max(m.depth, 0.5 * layer.near); // before all casters
    if (kind != BIAS_RECEIVER_PLANE && kind != BIAS_CONE) {
        ReceiverPlane r = flat_plane(layer, size, depth_step, m);
        if (kind == BIAS_TEXEL_WORLD || kind == BIAS_NORMAL_OFFSET) // what rasterisers' snapping of vertices takes
            r.z += stored_per_metre(layer, m.depth) * depth_within(layer, size, m, p, n, PLANE_SNAP);
        return r;
    }
    ReceiverPlane r = receiver_plane(layer, size, depth_step, m, p, n, radius, BIAS_SLOPE_LIMIT);
    if (kind == BIAS_CONE) r.cone = BIAS_CONE_OPENING * b.scale * stored_per_metre(layer, m.depth) * max(m.texel.x, m.texel.y);
    else r.slope *= b.scale;
    return r;
}

#endif
