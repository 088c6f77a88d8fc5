// SPDX-License-Identifier: Apache-2.0
// Lookups in the N-buffers, multiscale maps and Y maps of shadow/parts/n_buffer.h.
#ifndef GNOMON_N_BUFFER_GLSL
#define GNOMON_N_BUFFER_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/n_buffer.shared.h"
#include "shaders/pyramid.glsl"
#include "shaders/windows.glsl"

// The window of 2^level texels a side that begins at `first`.
vec2 min_max_square(sampler2DArray image, NBuffer b, int layer, ivec2 first, int level)
{
    const int back = b.centred != 0 ? (1 << level) >> 1 : 0;
    return texelFetch(image, ivec3(first + back, level * b.layers + layer), 0).xy;
}

// Exact least and greatest value of the texels from `first` to `last`, of the buffer's own: covered by squares as large as the short side
// holds, which may overlap. Four fetches do where the long side is at most twice such a square; a longer one takes more.
vec2 min_max_rectangle(sampler2DArray image, NBuffer b, int layer, ivec2 first, ivec2 last)
{
    const ivec2 side = last - first + 1;
    const int level = clamp(findMSB(min(side.x, side.y)), 0, b.levels - 1), width = 1 << level;
    vec2 result = min_max_square(image, b, layer, first, level);
    for (int y = first.y; y <= last.y; y += width)
        for (int x = first.x; x <= last.x; x += width)
            result = join_min_max(result, min_max_square(image, b, layer, min(ivec2(x, y), last + 1 - width), level));
    return result;
}

// Exact, of all texels that the window [lo, hi) touches.
vec2 min_max_window(sampler2DArray image, NBuffer b, int layer, vec2 lo, vec2 hi)
{
    const ivec2 size = textureSize(image, 0).xy;
    const ivec2 x = touched_texels(lo.x, hi.x, size.x), y = touched_texels(lo.y, hi.y, size.y);
    return min_max_rectangle(image, b, layer, ivec2(x.x, y.x), ivec2(x.y, y.y));
}

// Of a Y map: a pyramid for windows that a few fine texels hold, and for larger ones an N-buffer of the pyramid's coarsest level.
// Conservative: the window's ends are rounded outwards, to multiples of at most 2^coarseness texels.
vec2 min_max_window(sampler2DArray pyramid, sampler2DArray coarse, NBuffer b, int layer, vec2 lo, vec2 hi)
{
    const ivec2 size = textureSize(pyramid, 0).xy;
    const ivec2 x = touched_texels(lo.x, hi.x, size.x), y = touched_texels(lo.y, hi.y, size.y);
    const ivec2 first = ivec2(x.x, y.x), last = ivec2(x.y, y.y);
    const int level = two_texel_level(first, last);
    if (level < b.coarseness) return min_max_texels(pyramid, layer, first, last, level);
    const ivec2 most = textureSize(coarse, 0).xy - 1;
    return min_max_rectangle(coarse, b, layer, min(first >> b.coarseness, most), min(last >> b.coarseness, most));
}

// Mean over about the square of the given side around `middle` (texels), from a buffer of means under a linear sampler: exact for sides of
// 2^level wherever the square lies, between them interpolated. A square that reaches over the rim is moved inside.
vec4 mean_square(sampler2DArray image, NBuffer b, int layer, vec2 middle, float side)
{
    const vec2 size = vec2(textureSize(image, 0).xy);
    const float fine = clamp(log2(max(side, 1.0)), 0.0, float(b.levels - 1));
    vec4 means[2];
    for (int i = 0; i < 2; ++i) {
        const float level = min(floor(fine) + float(i), float(b.levels - 1)), width = exp2(level);
        const vec2 first = clamp(middle - 0.5 * width, vec2(0.0), max(size - width, vec2(0.0)));
        means[i] = textureLod(image, vec3((first + 0.5) / size, level * float(b.layers) + float(layer)), 0.0);
    }
    return mix(means[0], means[1], fract(fine));
}

#endif
