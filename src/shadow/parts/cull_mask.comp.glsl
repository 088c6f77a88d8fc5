// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "src/shadow/parts/cull.shared.h"
#include "src/shadow/parts/ordered_float.glsl"

// Marks in each layer where receivers look: those that are seen and face the light.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, scalar) buffer Mask { uint mask[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CullConstants c; };

void mark(int index, vec3 p_world)
{
    const LightMapLayer layer = c.map.layers[index];
    const MapPoint m = project(layer, p_world);
    const float step = float(CULL_MASK_SIZE) / c.map.size;
    const ivec2 most = ivec2(CULL_MASK_SIZE - 1);
    const ivec2 first = clamp(ivec2(floor((m.uv * c.map.size - c.reach) * step)), ivec2(0), most);
    const ivec2 last = clamp(ivec2(floor((m.uv * c.map.size + c.reach) * step)), ivec2(0), most);
    const uint depth = ordered_from_float(m.depth);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const int at = (index * CULL_MASK_SIZE + y) * CULL_MASK_SIZE + x;
            if (mask[at] < depth) atomicMax(mask[at], depth);
        }
}

void main()
{
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(c.view.size)))) return;
    Receiver r;
    float decided;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, vec2(pixel) + 0.5, r, decided)) return;
    const Layers layers = select_layers(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, c.map.bands, r.p_world);
    for (int i = 0; i < count_of(layers); ++i) mark(layers.first + i, r.p_world);
}
