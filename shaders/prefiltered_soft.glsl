// SPDX-License-Identifier: Apache-2.0
// The steps of percentage-closer soft shadows for methods that read averages over windows in place of texels: the window that the nearest
// blocker allows, the blockers' mean depth in it, the window of the penumbra, the lit part of that. Include the technique's shared header
// first: its ResolveConstants begins with a SoftResolve named `soft` and a PrefilteredSoft named `prefiltered`; then give the two functions
// declared below. Depths are centred (shaders/filter_values.glsl), and x = z - t is one relative to the receiver's plane: blockers have
// x < 0.
#ifndef GNOMON_PREFILTERED_SOFT_GLSL
#define GNOMON_PREFILTERED_SOFT_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/percentage_closer.glsl"
#include "shaders/pyramid.glsl"
#include "shaders/soft_map.glsl"

layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3) uniform sampler2DArray pyramid_image;

// The technique's. lo, hi: corners of a window, texels.
vec2 mean_blocker(vec2 lo, vec2 hi); // the window's blocked fraction, and the mean x of its blockers
float lit_part(vec2 lo, vec2 hi); // its lit fraction

// Of this pixel.
SoftPoint point;
LightMapLayer layer;
ReceiverPlane plane;
float half_range; // metres for one of centred depth
float blocker_depth; // metres, once mean_blocker has answered

float centred_from_stored(float z) { return centred_from_depth(layer, depth_from_stored(layer, z)); }

// Of the receiver's plane.
float receiver_depth(vec2 at) { return centred_from_stored(clamp(plane.z + dot(plane.slope, at - plane.at), 0.0, 1.0)); }

float texel_depth(ivec2 texel)
{
    return centred_from_stored(fetch_depth(map_image, point.layer, clamp(texel, ivec2(0), textureSize(map_image, 0).xy - 1)));
}

// Least and greatest stored depth around the receiver, and whether they decide: 1 or 0, or -1.
float decided(vec2 half_width, out vec2 range)
{
    range = min_max_window(pyramid_image, point.layer, plane.at - half_width, plane.at + half_width);
    const float reach = dot(abs(plane.slope), half_width);
    if (range.y <= max(plane.z - reach, 0.0)) return 1.0;
    return range.x > plane.z + reach ? 0.0 : -1.0;
}

// 3 x 3 bilinear comparisons over the window.
float contact_filter(vec2 half_width)
{
    const vec2 texel = 1.0 / vec2(textureSize(map_image, 0).xy);
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            lit += compare_tap(map_image, point.layer, plane, vec2(x, y) * half_width * (2.0 / 3.0), texel, true, false);
    return lit / 9.0;
}

float unblocked(SoftPoint p)
{
    point = p;
    layer = c.soft.map.layers[p.layer];
    half_range = 0.5 * (layer.far - layer.near);
    plane = ReceiverPlane(p.at, stored_from_depth(layer, p.depth), -p.slope * stored_per_metre(layer, p.depth), 0.0, vec2(0.0));

    // What is nearest in the window tells how far the window has to reach; whatever lies outside of the smaller one cannot block.
    const vec2 widest = vec2(0.5 * c.prefiltered.widest);
    vec2 half_width = min(window_half_width(layer, p.light, p.depth, layer.near), widest);
    float nearest = layer.near;
    for (int i = 0; i < 2; ++i) {
        vec2 range;
        const float known = decided(half_width, range);
        if (known >= 0.0) return known;
        nearest = depth_from_stored(layer, range.y);
        half_width = min(half_width, window_half_width(layer, p.light, p.depth, nearest));
    }

    half_width *= c.prefiltered.kernel_scale;
    const vec2 blocker = mean_blocker(p.at - half_width, p.at + half_width);
    if (blocker.x <= 0.0) return 1.0;

    blocker_depth = clamp(p.depth + blocker.y * half_range, min(nearest, p.depth), p.depth);
    half_width = window_half_width(layer, p.light, p.depth, blocker_depth);
    estimate_penumbra(p, half_width);
    half_width = min(c.prefiltered.kernel_scale * half_width, widest);
    vec2 range;
    const float known = decided(half_width, range);
    if (known >= 0.0) return known;
    if (p.depth - blocker_depth < c.prefiltered.contact) return contact_filter(half_width);
    return lit_part(p.at - half_width, p.at + half_width);
}

float soft_visibility(SoftPoint p) { return p.horizon * unblocked(p); }

#endif
