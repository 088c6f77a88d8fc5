// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/pcss/pcss.shared.h"

#include "shaders/chebyshev.glsl"
#include "shaders/noise.glsl"
#include "shaders/pyramid.glsl"
#include "shaders/soft_map.glsl"
#include "shaders/summed_area_table.glsl"

layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3) uniform sampler2D noise_image;
layout(set = 0, binding = 4) uniform sampler2DArray pyramid_image;
layout(set = 0, binding = 5) uniform usampler2DArray sums_image;

layout(constant_id = 0) const int pattern = PCSS_VOGEL;
layout(constant_id = 1) const int rotation = ROTATE_NONE;
layout(constant_id = 2) const bool box = false;
layout(constant_id = 3) const bool coned = true;
layout(constant_id = 4) const bool centred = false;
layout(constant_id = 5) const int shortcut = PCSS_SHORTCUT_BOTH;
layout(constant_id = 6) const int filtering = PCSS_FILTER_PCF;

#include "techniques/pcss/pcss_kernel.glsl"

// The steepest receiver that is followed, metres of depth a metre. At 16, wide windows reach past all casters where the light grazes, and light
// gets into closed boxes; at 4, floors shadow themselves under a sun 10 degrees high.
const float slope_limit = 8.0;
// Standard deviation that a window has at least, of the centred range of depths: as a variance shadow map's.
const float min_deviation = 2e-3;

ReceiverPlane make_plane(LightMapLayer layer, SoftPoint p, MapPoint m, float radius)
{
    const vec3 p_world = p.receiver.p_world, n = p.receiver.n_geometric;
    const float size = c.soft.map.size, depth_step = c.soft.map.depth_step;
    ReceiverPlane plane = coned ? cone_plane(layer, size, depth_step, m, p_world, n, c.params.bias_cone, slope_limit)
                                : receiver_plane(layer, size, depth_step, m, p_world, n, radius, slope_limit);
    const vec2 tangent = abs(receiver_tangent(layer, size, m, p_world, n, slope_limit));
    plane.z += c.soft.params.bias * dot(tangent, m.texel) * stored_per_metre(layer, m.depth);
    return plane;
}

// Least and greatest stored depth of all texels that a loop over the window may read.
vec2 window_depths(int index, vec2 at, vec2 half_size)
{
    return min_max_window(pyramid_image, index, at - half_size - 1.5, at + half_size + 1.5);
}

// 1 where all of the window is lit, 0 where all of it is blocked, -1 where it is mixed or the pyramid cannot tell.
float whole_window(vec2 depths, ReceiverPlane plane, vec2 half_size)
{
    const vec2 reach = half_size + 1.5;
    const float change = dot(abs(plane.slope), reach);
    if (shortcut >= PCSS_SHORTCUT_LIT && depths.y <= max(plane.z - change, 0.0)) return 1.0;
    // what lies beyond the map's rim is lit, and not in the pyramid
    const bool inside = all(greaterThanEqual(plane.at - reach, vec2(0.0))) && all(lessThanEqual(plane.at + reach, vec2(c.soft.map.size)));
    if (shortcut == PCSS_SHORTCUT_BOTH && inside && depths.x > max(plane.z + change + plane.cone * length(reach), 0.0)) return 0.0;
    return -1.0;
}

// From the near plane's window to that of the nearest depth in it, and so on: no blocker of the pyramid over the light is lost.
vec2 search_half_size(LightMapLayer layer, SoftPoint p, float depth, out float whole, ReceiverPlane plane)
{
    vec2 half_size = window_half_width(layer, p.light, depth, layer.near);
    whole = -1.0;
    for (int i = 0; i < c.params.refine && whole < 0.0; ++i) {
        const vec2 depths = window_depths(p.layer, plane.at, half_size);
        half_size = min(half_size, window_half_width(layer, p.light, depth, depth_from_stored(layer, depths.y)));
    }
    half_size = clamp(half_size, vec2(0.5 * c.params.least), vec2(0.5 * float(c.params.cap)));
    if (shortcut != PCSS_SHORTCUT_NONE) whole = whole_window(window_depths(p.layer, plane.at, half_size), plane, half_size);
    return half_size;
}

// Step two by Chebyshev's inequality over a summed-area table: a box as large as the light.
float sums_window(LightMapLayer layer, SoftPoint p, vec2 half_size)
{
    half_size *= box ? 1.0 : 0.8862269; // sqrt(pi) / 2
    const vec2 m = 2.0 * window_mean(sums_image, p.layer, p.at - half_size, p.at + half_size, c.sum_step).xy - 1.0;
    return chebyshev(m, centred_from_depth(layer, p.depth), min_deviation * min_deviation);
}

float soft_visibility(SoftPoint p)
{
    const LightMapLayer layer = layer_at(c.soft.map.layers[p.layer], p.receiver.p_world);
    const MapPoint m = project(layer, p.receiver.p_world);
    if (all(equal(p.light, vec2(0.0)))) {
        const vec2 texel = 1.0 / vec2(textureSize(map_image, 0).xy);
        return p.horizon * compare_tap(map_image, p.layer, make_plane(layer, p, m, 1.0), vec2(0.0), texel, false, coned);
    }
    const ReceiverPlane plane = make_plane(layer, p, m, 0.5 * float(c.params.cap) + 1.0);
    float whole;
    const vec2 searched = search_half_size(layer, p, m.depth, whole, plane);
    if (whole >= 0.0) return p.horizon * whole;
    const vec2 found = search_window(layer, p.layer, plane, searched);
    if (found.y <= 0.0) return p.horizon;
    const vec2 shadow = window_half_width(layer, p.light, m.depth, found.x / found.y);
    estimate_penumbra(p, shadow);
    const vec2 half_size = clamp(shadow, vec2(0.5 * c.params.least), vec2(0.5 * float(c.params.cap)));
    float lit = shortcut == PCSS_SHORTCUT_NONE ? -1.0 : whole_window(window_depths(p.layer, plane.at, half_size), plane, half_size);
    if (lit < 0.0) lit = filtering == PCSS_FILTER_SUMS ? sums_window(layer, p, half_size) : filter_window(p.layer, plane, half_size);
    return p.horizon * lit;
}
