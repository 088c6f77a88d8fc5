// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_map.glsl"
#include "tests/gpu/twins.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { MapCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { MapResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const vec3 p = cases[i].p_world;
    const int index = select_layer(cases[i].map.layout_kind, cases[i].map.centre, cases[i].map.axes, cases[i].map.splits, p);
    const Layers layers
        = select_layers(cases[i].map.layout_kind, cases[i].map.centre, cases[i].map.axes, cases[i].map.splits, cases[i].map.bands, p);
    const LightMapLayer layer = layer_at(cases[i].map.layers[index], p);
    const MapPoint m = project(layer, p);
    const float stored = stored_from_depth(layer, m.depth);
    results[i] = MapResult(index, layers.first == index ? layers.next : -1.0, m.uv, m.z, m.depth, m.inside ? 1 : 0, stored, reference_depth(layer, m.depth, cases[i].map.depth_step), depth_from_stored(layer, stored), m.texel);
}
