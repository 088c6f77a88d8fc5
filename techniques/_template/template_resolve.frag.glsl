// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "techniques/template_id/template_id.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArrayShadow map_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(location = 0) out float visibility;

float lit_in_layer(Receiver r, int index)
{
    const LightMapLayer layer = c.map.layers[index];
    const vec2 texels = project(layer, r.p_world).texel;
    const float texel = max(texels.x, texels.y);
    const MapPoint m = project(layer, r.p_world + r.n_geometric * (c.params.normal_offset * texel));
    return compare_depth(map_image, index, m.uv, reference_depth(layer, m.depth, c.map.depth_step));
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const Layers layers = select_layers(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, c.map.bands, r.p_world);
    visibility = 0.0;
    for (int i = 0; i < count_of(layers); ++i) visibility += share_of(layers, i) * lit_in_layer(r, layers.first + i);
}
