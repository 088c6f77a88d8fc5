// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/receiver_plane.glsl"
#include "techniques/hybrid_map_volume/hybrid_map_volume.shared.h"

// What the map says where all texels around a receiver say the same; the others are marked.
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray map_image;
layout(set = 0, binding = 3, scalar) buffer Marked { uint count, pixels[]; } marked;
layout(set = 0, binding = 4, scalar) buffer Groups { Dispatch groups; };
layout(set = 1, binding = 0, scalar) uniform Constants { HybridConstants c; };

layout(constant_id = 0) const int reach = 1;

layout(constant_id = 1) const bool left_open = false; // -1 where a pixel is marked

layout(location = 0) out float visibility;

const int LIT = 1, DARK = 0, UNKNOWN = -1;

// Metres of depth a metre across, as the light sees the receiver: of steeper ones, which it grazes, the map knows too little.
const float GRAZING = 16.0;

// Each texel is compared with the receiver's own plane at the texel's centre. What lies behind it, but for rounding, is the receiver itself
// or no blocker. What lies before it by more than a surface that rises by a metre a metre may reach blocks; anything between may be either.
int ask_map(Receiver r, int index)
{
    const LightMapLayer layer = layer_at(c.map.layers[index], r.p_world);
    const MapPoint m = project(layer, r.p_world);
    if (!m.inside) return UNKNOWN;
    const vec2 tangent = receiver_tangent(layer, c.map.size, m, r.p_world, r.n_geometric, 1e6);
    if (!(dot(tangent, tangent) < GRAZING * GRAZING)) return UNKNOWN;
    const float radius = 1.41421356 * (float(reach) + 0.5);
    const ReceiverPlane plane = receiver_plane(layer, c.map.size, c.map.depth_step, m, r.p_world, r.n_geometric, radius, 2.0 * GRAZING);
    const ivec2 middle = ivec2(floor(plane.at));
    if (any(lessThan(middle, ivec2(reach))) || any(greaterThanEqual(middle + reach, ivec2(c.map.size)))) return UNKNOWN;
    const float nearer = m.depth - c.bias_scale * radius * max(m.texel.x, m.texel.y);
    if (layer.perspective != 0 && nearer < 0.5 * layer.near) return UNKNOWN;
    const float bias = stored_from_depth(layer, nearer) - stored_from_depth(layer, m.depth);
    bool all_lit = true, all_dark = true;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            const ivec2 texel = middle + ivec2(x, y);
            const vec2 d = vec2(texel) + 0.5 - plane.at;
            const float z = plane.z + dot(plane.slope, d) / (1.0 + dot(plane.bend, d));
            const float stored = fetch_depth(map_image, index, texel);
            all_lit = all_lit && stored <= z;
            all_dark = all_dark && stored > z + bias;
        }
    return all_lit ? LIT : all_dark ? DARK : UNKNOWN;
}

void mark(uvec2 pixel)
{
    const uint at = atomicAdd(marked.count, 1u);
    marked.pixels[at] = pixel.y << 16 | pixel.x;
    if (at % MARKED_GROUP == 0u && at / MARKED_GROUP < MARKED_GROUPS) atomicAdd(groups.x, 1u);
}

void main()
{
    if (all(lessThan(gl_FragCoord.xy, vec2(1.0)))) groups.y = groups.z = 1u;
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const int answer = ask_map(r, select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, r.p_world));
    visibility = answer == LIT ? 1.0 : 0.0;
    if (answer != UNKNOWN) return;
    if (left_open) visibility = -1.0;
    mark(uvec2(gl_FragCoord.xy));
}
