// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

#include "shaders/n_buffer.glsl"
#include "shaders/soft_map.glsl"

layout(set = 0, binding = 3) uniform sampler2DArray means_image;

layout(constant_id = 4) const bool mips = false;

vec4 mean_around(vec2 middle, float side, int layer)
{
    if (!mips) return mean_square(means_image, c.n_buffer, layer, middle, side);
    return textureLod(means_image, vec3(middle / vec2(textureSize(means_image, 0).xy), float(layer)), log2(max(side, 1.0)));
}

// Covered part of about the window [lo, hi) of a slice: means of squares as wide as its short side, side by side along the long one.
float covered(int map_layer, int slice, vec2 lo, vec2 hi)
{
    const vec2 size = hi - lo;
    const float widest = mips ? 1e9 : exp2(float(c.n_buffer.levels - 1));
    const float least = clamp(min(size.x, size.y), 1.0, widest);
    const ivec2 n = clamp(ivec2(ceil(size / least - 0.01)), ivec2(1), ivec2(4));
    const float side = clamp(max(size.x / float(n.x), size.y / float(n.y)), 1.0, widest);
    float sum = 0.0;
    for (int y = 0; y < n.y; ++y)
        for (int x = 0; x < n.x; ++x)
            sum += mean_around(lo + size * (vec2(x, y) + 0.5) / vec2(n), side, (slice >> 2) * int(c.soft.map.layer_count) + map_layer)[slice & 3];
    return sum / float(n.x * n.y);
}

#include "techniques/occlusion_textures/occlusion_textures_resolve.glsl"
