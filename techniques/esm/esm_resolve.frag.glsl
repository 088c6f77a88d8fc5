// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/esm/esm.shared.h"

#include "shaders/filter_resolve.glsl"
#include "techniques/esm/esm.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray values_image; // before averaging
layout(set = 0, binding = 5) uniform sampler2DArray largest_image; // in each window; read for max_depth

float exponential(float value, float t) { return esm_exponential(value, t, c.params.exponent, c.params.space == 1); }

float mean_exponential(FilterPoint at)
{
    if (c.params.space == 0) return exponential(window_mean(at, 0).x, at.t);
    // logarithms cannot be blended: the four windows around the point are, after the exponential
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        const WindowTexel w = window_texel(at, i);
        sum += w.weight * exponential(texelFetch(means_image, ivec3(w.texel, at.layer), 0).x, at.t);
    }
    return sum;
}

bool any_behind(FilterPoint at) { return exponential(window_range(largest_image, at).y, at.t) > 1.0 + c.params.threshold; }

// What the mean would be if the window held the receiver's own plane and nothing else: the mean of exp(c (gx x + gy y) / 2) over n x n
// texels is a product of sinh(a) / a with a = c g n / 4.
float mean_of_plane(FilterPoint at)
{
    const vec2 a = min(0.25 * c.params.exponent * abs(at.slope) * float(c.filtering.params.kernel), vec2(20.0));
    const vec2 s = mix(sinh(a) / max(a, vec2(1e-3)), vec2(1.0), lessThan(a, vec2(1e-3)));
    return s.x * s.y;
}

// Percentage-closer filtering of the exponentials, each against the receiver's plane and cut off at 1 (Annen et al. 2008, section 4): what
// their mean would be, had no texel lain behind the receiver. The weights are those of window_mean.
float clamped_exponentials(FilterPoint at)
{
    const int n = c.filtering.params.kernel;
    const vec2 corner = at.uv * c.filtering.map.size - 0.5 * float(n);
    const vec2 first = floor(corner), f = corner - first, from_receiver = first + 0.5 - at.uv * c.filtering.map.size;
    float sum = 0.0;
    for (int y = 0; y <= n; y += 2) {
        const vec2 wy = vec2(y == 0 ? 1.0 - f.y : y == n ? f.y : 1.0, y + 1 > n ? 0.0 : y + 1 == n ? f.y : 1.0);
        for (int x = 0; x <= n; x += 2) {
            const vec2 wx = vec2(x == 0 ? 1.0 - f.x : x == n ? f.x : 1.0, x + 1 > n ? 0.0 : x + 1 == n ? f.x : 1.0);
            // order of a gather: (0,1) (1,1) (1,0) (0,0)
            const vec4 values = textureGather(values_image, vec3((first + vec2(x + 1, y + 1)) / c.filtering.map.size, float(at.layer)));
            const vec2 d = from_receiver + vec2(x, y);
            const vec4 t = at.t + at.slope.x * (d.x + vec4(0, 1, 1, 0)) + at.slope.y * (d.y + vec4(1, 1, 0, 0));
            const vec4 shift = 0.5 * c.params.exponent * t;
            const vec4 lit = min(c.params.space == 1 ? exp(min(values - shift, 0.0)) : values * exp(-shift), 1.0);
            sum += dot(lit, vec4(wx.x * wy.y, wx.y * wy.y, wx.y * wy.x, wx.x * wy.x));
        }
    }
    return sum / float(n * n);
}

float filtered_visibility(FilterPoint at)
{
    const float mean = mean_exponential(at);
    const bool broken = c.params.fallback == 1 ? mean > mean_of_plane(at) + c.params.threshold : c.params.fallback == 2 && any_behind(at);
    return min(broken ? clamped_exponentials(at) : mean, 1.0);
}
