// SPDX-License-Identifier: Apache-2.0
// How many pixels a texel of the map covers at each pixel's surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/receiver.glsl"
#include "shaders/texel_footprint.glsl"
#include "src/shadow/parts/texel_footprint.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 1, binding = 0, scalar) uniform Constants { TexelFootprintConstants c; };

layout(location = 0) out vec4 footprint;

void main()
{
    footprint = vec4(0.0);
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    if (r.background) return;
    const LightMapLayer layer
        = layer_at(c.map.layers[select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, r.p_world)], r.p_world);
    if (!project(layer, r.p_world).inside || dot(r.n_geometric, map_ray(layer, r.p_world)) <= 0.0) return;
    const TexelFootprint f = texel_footprint(c.view, layer, c.map.size, r.p_world, r.n_geometric);
    footprint = vec4(longer_edge(f.total), longer_edge(f.perspective), f.projection, 0.0);
}
