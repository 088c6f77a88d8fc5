// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

#include "shaders/soft_map.glsl"
#include "shaders/summed_area_table.glsl"

layout(set = 0, binding = 3) uniform usampler2DArray sums_image;

// One slice's counts out of words that hold two.
vec3 counts(uvec3 words, bool high) { return vec3(high ? words >> 16 : words & 0xffffu); }

// As window_total of shaders/summed_area_table.glsl.
float packed_total(uvec4 a, uvec4 b, uvec4 d, uvec4 e, WindowRuns x, WindowRuns y, bool high)
{
    const uvec4 upper = uvec4(a.xy, b.xy), lower = uvec4(d.wz, e.wz);
    const uvec4 first = upper - uvec4(a.wz, b.wz), inner = lower - upper, last = uvec4(d.xy, e.xy) - lower;
    return y.weight.x * dot(x.weight, counts(first.yzw - first.xyz, high)) + y.weight.y * dot(x.weight, counts(inner.yzw - inner.xyz, high))
        + y.weight.z * dot(x.weight, counts(last.yzw - last.xyz, high));
}

// Windows of more texels than a half word counts: whole texels, in parts.
float count_in_parts(int layer, int channel, bool high, ivec2 lo, ivec2 hi)
{
    const int widest = 255;
    float count = 0.0;
    for (int y = lo.y; y < hi.y; y += widest)
        for (int x = lo.x; x < hi.x; x += widest) {
            const uint word = window_sum(sums_image, layer, ivec2(x, y), min(ivec2(x, y) + widest, hi))[channel];
            count += float(high ? word >> 16 : word & 0xffffu);
        }
    return count;
}

#define GATHER(I)                                                                                                                          \
    packed_total(textureGather(sums_image, vec3(near, layer), I), textureGather(sums_image, vec3(far.x, near.y, layer), I),                \
        textureGather(sums_image, vec3(near.x, far.y, layer), I), textureGather(sums_image, vec3(far, layer), I), x, y, high)

// Covered part of the window [lo, hi) of a slice: exact.
float covered(int map_layer, int slice, vec2 lo, vec2 hi)
{
    const int channel = slice & 3, group = slice >> 2, layer = (group >> 1) * int(c.soft.map.layer_count) + map_layer;
    const bool high = (group & 1) != 0;
    const ivec2 entries = textureSize(sums_image, 0).xy;
    lo = clamp(lo, vec2(0.0), vec2(entries - 1));
    hi = clamp(hi, vec2(0.0), vec2(entries - 1));
    if (any(greaterThan(hi - lo, vec2(255.0)))) {
        const ivec2 first = ivec2(round(lo)), last = max(ivec2(round(hi)), first + 1);
        const vec2 size = vec2(last - first);
        return count_in_parts(layer, channel, high, first, last) / (size.x * size.y);
    }
    const WindowRuns x = window_runs(lo.x, hi.x, entries.x - 1), y = window_runs(lo.y, hi.y, entries.y - 1);
    const vec2 near = vec2(x.at.y, y.at.y) / vec2(entries), far = vec2(x.at.w, y.at.w) / vec2(entries);
    const float total = channel == 0 ? GATHER(0) : channel == 1 ? GATHER(1) : channel == 2 ? GATHER(2) : GATHER(3);
    return total / (window_width(x) * window_width(y));
}

#include "techniques/occlusion_textures/occlusion_textures_resolve.glsl"
