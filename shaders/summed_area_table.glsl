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
    // Of one texel the mean is its value, whatever part is covered. The gathers take the entries at [0] and [1], and at [2] and [3], as
    // neighbours; here the latter are any.
    if (first == last) return WindowRuns(ivec4(first, ivec3(first + 1)), vec3(1.0, 0.0, 0.0));
    return WindowRuns(
        ivec4(first, first + 1, last, last + 1), vec3(float(first + 1) - max(lo, 0.0), 1.0, min(hi, float(size)) - float(last)));
}

float window_width(WindowRuns r) { return r.weight.x + r.weight.y * float(r.at.z - r.at.y) + r.weight.z; }

// Weighted sum of one channel over the 3 x 3 runs, from the table's 4 x 4 entries at their ends, gathered in blocks of 2 x 2: a gather's order
// is (0,1) (1,1) (1,0) (0,0).
float window_total(vec4 a, vec4 b, vec4 c, vec4 d, WindowRuns x, WindowRuns y)
{
    const vec4 upper = vec4(a.xy, b.xy), lower = vec4(c.wz, d.wz);
    const vec4 rows = y.weight.x * (upper - vec4(a.wz, b.wz)) + y.weight.y * (lower - upper) + y.weight.z * (vec4(c.xy, d.xy) - lower);
    return dot(x.weight, rows.yzw - rows.xyz);
}

// The same, but integers until both differences are taken, so that wrap-around cancels.
float window_total(uvec4 a, uvec4 b, uvec4 c, uvec4 d, WindowRuns x, WindowRuns y)
{
    const uvec4 upper = uvec4(a.xy, b.xy), lower = uvec4(c.wz, d.wz);
    const uvec4 first = upper - uvec4(a.wz, b.wz), inner = lower - upper, last = uvec4(c.xy, d.xy) - lower;
    return y.weight.x * dot(x.weight, vec3(first.yzw - first.xyz)) + y.weight.y * dot(x.weight, vec3(inner.yzw - inner.xyz))
        + y.weight.z * dot(x.weight, vec3(last.yzw - last.xyz));
}

#define GNOMON_WINDOW_CHANNEL(I)                                                                                                           \
    window_total(textureGather(sums, vec3(near, layer), I), textureGather(sums, vec3(far.x, near.y, layer), I),                            \
        textureGather(sums, vec3(near.x, far.y, layer), I), textureGather(sums, vec3(far, layer), I), x, y)

// Mean over the part of the window that lies in the image. Four gathers for each channel that the caller uses; the compiler drops the
// others. On lavapipe, 16 fetches of all channels take two to three times as long for one channel and as long for four.
#define GNOMON_WINDOW_MEAN(SAMPLER)                                                                                                        \
    vec4 window_mean_of(SAMPLER sums, int layer, vec2 lo, vec2 hi)                                                                         \
    {                                                                                                                                      \
        const ivec2 entries = textureSize(sums, 0).xy;                                                                                     \
        const WindowRuns x = window_runs(lo.x, hi.x, entries.x - 1), y = window_runs(lo.y, hi.y, entries.y - 1);                           \
        const vec2 near = vec2(x.at.y, y.at.y) / vec2(entries), far = vec2(x.at.w, y.at.w) / vec2(entries);                                \
        return vec4(GNOMON_WINDOW_CHANNEL(0), GNOMON_WINDOW_CHANNEL(1), GNOMON_WINDOW_CHANNEL(2), GNOMON_WINDOW_CHANNEL(3))                \
            / (window_width(x) * window_width(y));                                                                                         \
    }

GNOMON_WINDOW_MEAN(sampler2DArray)
GNOMON_WINDOW_MEAN(usampler2DArray)
#undef GNOMON_WINDOW_CHANNEL
#undef GNOMON_WINDOW_MEAN

// Of float sums. What was taken off as `centre` is for the caller to add.
vec4 window_mean(sampler2DArray sums, int layer, vec2 lo, vec2 hi) { return window_mean_of(sums, layer, lo, hi); }

// Of integer sums; `step_value` is integer_sum_step(bits).
vec4 window_mean(usampler2DArray sums, int layer, vec2 lo, vec2 hi, float step_value)
{
    return step_value * window_mean_of(sums, layer, lo, hi);
}

#endif
