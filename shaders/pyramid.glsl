// SPDX-License-Identifier: Apache-2.0
// Lookups in the pyramids of shadow/parts/pyramid.h.
#ifndef GNOMON_PYRAMID_GLSL
#define GNOMON_PYRAMID_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/windows.glsl"

// The finest level at which [first, last] spans at most two texels. One below the level where a texel is as wide as the span does where
// the span happens to lie well; two below never does.
int two_texel_level(ivec2 first, ivec2 last)
{
    const int span = max(last.x - first.x, last.y - first.y);
    const int level = span == 0 ? 0 : findMSB(span) + 1;
    if (level == 0) return 0;
    const ivec2 finer = (last >> (level - 1)) - (first >> (level - 1));
    return max(finer.x, finer.y) <= 1 ? level - 1 : level;
}

// Least and greatest value over the 2 x 2 texels of one level that hold [first, last].
vec2 min_max_texels(sampler2DArray pyramid, int layer, ivec2 first, ivec2 last, int level)
{
    // not textureSize(pyramid, level): lavapipe answers with one lane's level for all
    const ivec2 most = max(textureSize(pyramid, 0).xy >> level, 1) - 1;
    const ivec2 a = min(first >> level, most), b = min(last >> level, most);
    const vec2 top = join_min_max(texelFetch(pyramid, ivec3(a, layer), level).xy, texelFetch(pyramid, ivec3(b.x, a.y, layer), level).xy);
    const vec2 bottom = join_min_max(texelFetch(pyramid, ivec3(a.x, b.y, layer), level).xy, texelFetch(pyramid, ivec3(b, layer), level).xy);
    return join_min_max(top, bottom);
}

// Conservative: x at most the least, y at least the greatest value of the texels that the window [lo, hi) touches. Four fetches, over an
// area up to four times as wide as the window. The pyramid needs all its levels.
vec2 min_max_window(sampler2DArray pyramid, int layer, vec2 lo, vec2 hi)
{
    const ivec2 size = textureSize(pyramid, 0).xy;
    const ivec2 x = touched_texels(lo.x, hi.x, size.x), y = touched_texels(lo.y, hi.y, size.y);
    const ivec2 first = ivec2(x.x, y.x), last = ivec2(x.y, y.y);
    const int level = min(two_texel_level(first, last), textureQueryLevels(pyramid) - 1);
    return min_max_texels(pyramid, layer, first, last, level);
}

#endif
