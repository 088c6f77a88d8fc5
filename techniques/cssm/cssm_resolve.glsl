// SPDX-License-Identifier: Apache-2.0
// The two steps of percentage-closer soft shadows, each from a Fourier series. Include before `vec4 window_value(sampler, array layer, lo,
// hi)` and the images of waves, waves times depth, and depth; SAMPLER is their type.
#ifndef GNOMON_CSSM_RESOLVE_GLSL
#define GNOMON_CSSM_RESOLVE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/prefiltered_soft.glsl"
#include "techniques/cssm/cssm_depth.glsl"
#include "techniques/cssm/cssm_kernel.glsl"

layout(constant_id = 0) const int groups = 2;
layout(constant_id = 1) const int correction = CORRECT_LEVEL;
layout(constant_id = 2) const int iterations = 2;

layout(set = 0, binding = 4) uniform SAMPLER waves_image;
layout(set = 0, binding = 5) uniform SAMPLER depth_waves_image;
layout(set = 0, binding = 6) uniform SAMPLER mean_depth_image;

vec4 window_value(SAMPLER values, int layer, vec2 lo, vec2 hi);

vec4 mean_waves(int i, vec2 lo, vec2 hi) { return 2.0 * window_value(waves_image, point.layer * groups + i, lo, hi) - 1.0; }
vec4 mean_depth_waves(int i, vec2 lo, vec2 hi) { return 2.0 * window_value(depth_waves_image, point.layer * groups + i, lo, hi) - 1.0; }
float mean_depth(vec2 lo, vec2 hi) { return 2.0 * window_value(mean_depth_image, point.layer, lo, hi).x - 1.0; }

Series series() { return Series(groups, c.series.scale, c.series.shift, c.series.fill); }

float range_start() { return first_depth(layer, pyramid_image, point.layer, c.params.tight != 0); }

float receiver(float first) { return clamp(wave_depth(layer, first, point.depth), -1.0, 1.0); }

vec2 mean_blocker(vec2 lo, vec2 hi)
{
    const float first = range_start();
    const float to_centred = (layer.far - first) / (2.0 * half_range);
    vec2 blocker = blocker_series(series(), receiver(first), lo, hi, c.params.least);
    for (int i = 0; i < iterations && blocker.x > 0.0; ++i) {
        const float depth = clamp(point.depth + blocker.y * to_centred * half_range, first, max(first, point.depth));
        const vec2 half_width = min(0.5 * (hi - lo), c.prefiltered.kernel_scale * window_half_width(layer, point.light, point.depth, depth));
        const vec2 nearer = blocker_series(series(), receiver(first), point.at - half_width, point.at + half_width, c.params.least);
        if (nearer.x <= 0.0) break;
        blocker = nearer;
    }
    return vec2(blocker.x, min(blocker.y, 0.0) * to_centred);
}

float lit_part(vec2 lo, vec2 hi)
{
    const float first = range_start(), t = receiver(first);
    const float lit = lit_series(series(), t, lo, hi);
    if (correction == CORRECT_LEVEL) return above_level(lit, lit_level(series(), t, wave_depth(layer, first, blocker_depth)));
    const float cut = clamp(lit, 0.0, 1.0);
    if (correction == CORRECT_NONE) return cut;
    const float distance = (point.depth - blocker_depth) / (layer.far - first);
    return pow(cut, 1.0 + c.params.sharpening * exp(-c.params.reach * distance));
}

#endif
