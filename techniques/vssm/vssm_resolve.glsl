// SPDX-License-Identifier: Apache-2.0
// The two steps of percentage-closer soft shadows, each from moments. Include after stored_moments(layer, lo, hi), which reads the
// summed-area table.
#ifndef GNOMON_VSSM_RESOLVE_GLSL
#define GNOMON_VSSM_RESOLVE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/percentage_closer.glsl"
#include "shaders/pyramid.glsl"
#include "techniques/vssm/vssm_kernel.glsl"

layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3) uniform sampler2DArray pyramid_image;

layout(constant_id = 0) const int search_subdivision = SUBDIVIDE_UNIFORM;
layout(constant_id = 1) const int filter_subdivision = SUBDIVIDE_ADAPTIVE;
layout(constant_id = 2) const bool per_cell = true;

// Of this pixel: what the functions of vssm_kernel.glsl ask for.
int layer_index;
float layer_near, layer_far;
bool layer_perspective;
ReceiverPlane plane;

float centred_from_stored(float z)
{
    const float depth = layer_perspective ? layer_near * layer_far / (z * (layer_far - layer_near) + layer_near)
                                          : layer_far - z * (layer_far - layer_near);
    return 2.0 * (depth - layer_near) / (layer_far - layer_near) - 1.0;
}

float plane_stored(vec2 at) { return clamp(plane.z + dot(plane.slope, at - plane.at), 0.0, 1.0); }
float receiver_depth(vec2 at) { return centred_from_stored(plane_stored(at)); }
vec2 window_moments(vec2 lo, vec2 hi) { return stored_moments(layer_index, lo, hi); }
float texel_depth(ivec2 texel)
{
    return centred_from_stored(fetch_depth(map_image, layer_index, clamp(texel, ivec2(0), textureSize(map_image, 0).xy - 1)));
}

// Least and greatest stored depth around the receiver, and whether they decide: 1 or 0, or -1.
float decided(vec2 half_width, out vec2 range)
{
    range = min_max_window(pyramid_image, layer_index, plane.at - half_width, plane.at + half_width);
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
            lit += compare_tap(map_image, layer_index, plane, vec2(x, y) * half_width * (2.0 / 3.0), texel, true, false);
    return lit / 9.0;
}

float unblocked(SoftPoint p)
{
    const LightMapLayer layer = c.soft.map.layers[p.layer];
    layer_index = p.layer;
    layer_near = layer.near;
    layer_far = layer.far;
    layer_perspective = layer.perspective != 0;
    plane = ReceiverPlane(p.at, stored_from_depth(layer, p.depth), -p.slope * stored_per_metre(layer, p.depth), 0.0);

    // What is nearest in the window tells how far the window has to reach; whatever lies outside of the smaller one cannot block.
    const vec2 widest = vec2(0.5 * c.widest);
    vec2 half_width = min(window_half_width(layer, p.light, p.depth, layer.near), widest);
    float nearest = layer.near;
    for (int i = 0; i < 2; ++i) {
        vec2 range;
        const float known = decided(half_width, range);
        if (known >= 0.0) return known;
        nearest = depth_from_stored(layer, range.y);
        half_width = min(half_width, window_half_width(layer, p.light, p.depth, nearest));
    }

    const float metres = 0.5 * (layer.far - layer.near); // for one of centred depth
    const float flat_deviation = 2.0 * c.params.flat_deviation, min_deviation = 2.0 * c.params.min_deviation;
    const KernelSettings k = KernelSettings(flat_deviation * flat_deviation, min_deviation * min_deviation, p.slope / metres, c.params.grid,
        c.params.height, per_cell);
    half_width *= c.kernel_scale;
    const vec2 blocker = mean_blocker(weigh_kernel(k, p.at - half_width, p.at + half_width, search_subdivision), k);
    if (blocker.x <= 0.0) return 1.0;

    const float blocker_depth = clamp(p.depth + blocker.y * metres, min(nearest, p.depth), p.depth);
    half_width = min(c.kernel_scale * window_half_width(layer, p.light, p.depth, blocker_depth), widest);
    vec2 range;
    const float known = decided(half_width, range);
    if (known >= 0.0) return known;
    if (p.depth - blocker_depth < c.params.contact * c.scene_radius) return contact_filter(half_width);
    return kernel_visibility(
        weigh_kernel(k, p.at - half_width, p.at + half_width, filter_subdivision), k, c.params.bleed_reduction);
}

void main()
{
    SoftPoint p;
    if (find_soft_point(p)) visibility = p.horizon * unblocked(p);
}

#endif
