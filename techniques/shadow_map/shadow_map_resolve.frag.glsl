// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/bias.glsl"
#include "shaders/hard_receiver.glsl"
#include "shaders/ids.glsl"
#include "techniques/shadow_map/shadow_map.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray map_image;
// for ids alone; otherwise anything of that kind
layout(set = 0, binding = 3) uniform usampler2D primitive_image;
layout(set = 0, binding = 4) uniform usampler2DArray ids_image;
layout(set = 0, binding = 5, scalar) readonly buffer Starts { uint count, first_primitive[]; } starts;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

// Known to the compiler, so that the filter's loops are unrolled.
layout(constant_id = 0) const int pcf = 3;
layout(constant_id = 1) const int bias = BIAS_CONE;
layout(constant_id = 2) const bool bilinear = true;

layout(location = 0) out float visibility;

// The first primitive of the instance that a primitive belongs to.
uint instance_of(uint primitive)
{
    uint first = 0, end = starts.count;
    while (end - first > 1) {
        const uint middle = (first + end) / 2;
        if (starts.first_primitive[middle] <= primitive) first = middle;
        else end = middle;
    }
    return starts.first_primitive[first];
}

float lit_in_layer(Receiver r, int index)
{
    bool inside;
    const ReceiverPlane plane = biased_plane(bias, c.params.bias, layer_at(c.map.layers[index], r.p_world), c.map.size, c.map.depth_step,
        c.light, r.p_world, r.n_geometric, c.reach, inside);
    if (!inside) return 1.0;
    if (bias == BIAS_IDS) {
        const uint own = instance_of(texelFetch(primitive_image, ivec2(gl_FragCoord.xy), 0).r);
        return ids_filter(map_image, ids_image, index, plane, own, pcf, bilinear);
    }
    return separable_filter(
        map_image, index, plane, pcf, false, bilinear ? RECONSTRUCT_BILINEAR : RECONSTRUCT_NEAREST, bias == BIAS_CONE, false);
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const Layers layers = select_layers(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, c.map.bands, r.p_world);
    visibility = 0.0;
    for (int i = 0; i < count_of(layers); ++i) visibility += share_of(layers, i) * lit_in_layer(r, layers.first + i);
}
