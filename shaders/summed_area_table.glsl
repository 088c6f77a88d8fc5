// SPDX-License-Identifier: Apache-2.0
// Sums and means over windows (shaders/windows.glsl) from a summed-area table (shadow/parts/summed_area_table.h), of floats or of
// integers that wrap around. Windows may begin and end inside texels, which then count by the part that is covered, as in a box filter of the
// image as nearest sampling shows it. Channels that the table lacks come out as 0.
#ifndef GNOMON_SUMMED_AREA_TABLE_GLSL
#define GNOMON_SUMMED_AREA_TABLE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/windows.glsl"

// Over whole texels, lo <= texel < hi, both within [0, size]: four fetches.
vec4 window_sum(sampler2DArray sums, int layer, ivec2 lo, ivec2 hi)
{
    return texelFetch(sums, ivec3(hi, layer), 0) - texelFetch(sums, ivec3(lo.x, hi.y, layer), 0)
        - (texelFetch(sums, ivec3(hi.x, lo.y, layer), 0) - texelFetch(sums, ivec3(lo, layer), 0));
}

uvec4 window_sum(usampler2DArray sums, int layer, ivec2 lo, ivec2 hi)
{
    return texelFetch(sums, ivec3(hi, layer), 0) - texelFetch(sums, ivec3(lo.x, hi.y, layer), 0)
        - (texelFetch(sums, ivec3(hi.x, lo.y, layer), 0) - texelFetch(sums, ivec3(lo, layer), 0));
}

// A window along one axis as three runs of texels with their weights: the texel in which it begins, those between, the texel in
// which it ends. Interpolating the table itself would add up the differences that the weights here multiply, but in numbers as large as
// the table's, and could not bear wrap-around.
struct WindowRuns {
    ivec4 at; // first texel of the runs, and the end of the last
    vec3 weight;
};

WindowRuns window_runs(float lo, float hi, int size)
{
    const ivec2 touched = touched_texels(lo, hi, size);
    const int first = touched.x, last = touched.y;
    // of one texel the mean is its value, whatever part is covered
    if (first == last) return WindowRuns(ivec4(first, ivec3(first + 1)), vec3(1.0, 0.0, 0.0));
    return WindowRuns(
        ivec4(first, first + 1, last, last + 1), vec3(float(first + 1) - max(lo, 0.0), 1.0, min(hi, float(size)) - float(last)));
}

float window_width(WindowRuns r) { return r.weight.x + r.weight.y * float(r.at.z - r.at.y) + r.weight.z; }

// Mean over the part of the window that lies in the image; 16 fetches.
#define GNOMON_WINDOW_MEAN(SAMPLER, VALUE)                                                                                              \
    vec4 window_mean_of(SAMPLER sums, int layer, WindowRuns x, WindowRuns y)                                                           \
    {                                                                                                                                  \
        vec4 total = vec4(0.0);                                                                                                        \
        VALUE above[4];                                                                                                                \
        for (int i = 0; i < 4; ++i) above[i] = texelFetch(sums, ivec3(x.at[i], y.at[0], layer), 0);                                   \
        for (int j = 0; j < 3; ++j) {                                                                                                  \
            VALUE below[4];                                                                                                            \
            for (int i = 0; i < 4; ++i) below[i] = texelFetch(sums, ivec3(x.at[i], y.at[j + 1], layer), 0);                           \
            for (int i = 0; i < 3; ++i)                                                                                                \
                total += (x.weight[i] * y.weight[j]) * vec4((below[i + 1] - below[i]) - (above[i + 1] - above[i]));                    \
            above = below;                                                                                                             \
        }                                                                                                                              \
        return total / (window_width(x) * window_width(y));                                                                            \
    }
GNOMON_WINDOW_MEAN(sampler2DArray, vec4)
GNOMON_WINDOW_MEAN(usampler2DArray, uvec4)
#undef GNOMON_WINDOW_MEAN

// Of float sums. What was taken off as `centre` is for the caller to add.
vec4 window_mean(sampler2DArray sums, int layer, vec2 lo, vec2 hi)
{
    const ivec2 size = textureSize(sums, 0).xy - 1;
    return window_mean_of(sums, layer, window_runs(lo.x, hi.x, size.x), window_runs(lo.y, hi.y, size.y));
}

// Of integer sums; `step_value` is integer_sum_step(bits).
vec4 window_mean(usampler2DArray sums, int layer, vec2 lo, vec2 hi, float step_value)
{
    const ivec2 size = textureSize(sums, 0).xy - 1;
    return step_value * window_mean_of(sums, layer, window_runs(lo.x, hi.x, size.x), window_runs(lo.y, hi.y, size.y));
}

#endif
