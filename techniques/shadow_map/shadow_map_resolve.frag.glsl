// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "techniques/shadow_map/shadow_map.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArrayShadow map_image;
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

// Known to the compiler, so that the filter's loops are unrolled.
layout(constant_id = 0) const int pcf = 3;

layout(location = 0) out float visibility;

float lit_in_layer(Receiver r, int index)
{
    const LightMapLayer layer = c.map.layers[index];
    // Normal offset: along the normal by the texel's width in the world, more where the surface turns away from the light and a
    // texel covers more depth (Holbert 2011, "Saying Goodbye to Shadow Acne").
    const float cos_light = dot(r.n_geometric, to_light(c.light, r.p_world).xyz);
    const vec2 texels = project(layer, r.p_world).texel;
    const float texel = max(texels.x, texels.y);
    const vec3 p = r.p_world + r.n_geometric * (c.params.normal_offset * texel * sqrt(max(0.0, 1.0 - cos_light * cos_light)));

    const MapPoint m = project(layer, p);
    const float z = reference_depth(layer, m.depth - c.params.bias_constant, c.map.depth_step);
    return box_filter(map_image, index, m.uv * c.map.size, z, pcf, c.params.bilinear != 0);
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const Layers layers = select_layers(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, c.map.bands, r.p_world);
    visibility = 0.0;
    for (int i = 0; i < count_of(layers); ++i) visibility += share_of(layers, i) * lit_in_layer(r, layers.first + i);
}
