// SPDX-License-Identifier: Apache-2.0
// Windows of texels, as all lookups take them: [lo, hi) where texel i covers [i, i + 1), clipped to the image. An empty window is
// the texel nearest to its middle, the limit of ever smaller ones.
#ifndef GNOMON_WINDOWS_GLSL
#define GNOMON_WINDOWS_GLSL

// First and last texel that the window touches along one axis.
ivec2 touched_texels(float lo, float hi, int size)
{
    lo = clamp(lo, 0.0, float(size));
    hi = clamp(hi, 0.0, float(size));
    if (!(lo < hi)) return ivec2(clamp(int(floor(0.5 * (lo + hi))), 0, size - 1));
    return ivec2(int(floor(lo)), int(ceil(hi)) - 1);
}

vec2 join_min_max(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

#endif
