// SPDX-License-Identifier: Apache-2.0
// Where a receiver stands in a prefiltered map, and the mean of the window around it: all of the resolve shader of a prefiltered map but
// the function declared below. Include the technique's shared header first: its ResolveConstants begins with a FilterResolve named
// `filtering`.
#ifndef GNOMON_FILTER_RESOLVE_GLSL
#define GNOMON_FILTER_RESOLVE_GLSL
#include "shaders/anisotropic.glsl"
#include "shaders/filter.shared.h"
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "shaders/receiver_plane.glsl"
#include "shaders/summed_area_table.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2DArray means_image; // of the values, one window a texel
layout(set = 0, binding = 3) uniform usampler2DArray sums_image; // PREFILTER_SUMS
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };

layout(constant_id = 0) const int prefilter = PREFILTER_BOX;

layout(location = 0) out float visibility;

struct FilterPoint {
    int layer; // of the map
    vec2 uv;
    float t; // centred depth (filter_values.glsl) of the receiver, moved towards the light by its bias
    vec2 dx, dy; // the pixel's footprint: change of uv from it to the next ones
    vec2 slope; // change of t along the receiver's plane, by one texel to the right and one down
};

// The technique's.
float filtered_visibility(FilterPoint at);

FilterPoint filter_point(Receiver r, int index)
{
    FilterPoint at;
    at.layer = index;
    const LightMapLayer layer = layer_at(c.filtering.map.layers[at.layer], r.p_world);
    const MapPoint m = project(layer, r.p_world);
    at.uv = m.uv;
    at.dx = at.dy = vec2(0.0);
    if (prefilter == PREFILTER_MIPS || prefilter == PREFILTER_SUMS) {
        const vec2 pixel = gl_FragCoord.xy;
        at.dx = project(layer, beside_on_plane(c.filtering.view, r.p_world, r.n_geometric, pixel, pixel + vec2(1, 0))).uv - m.uv;
        at.dy = project(layer, beside_on_plane(c.filtering.view, r.p_world, r.n_geometric, pixel, pixel + vec2(0, 1))).uv - m.uv;
    }
    const float per_metre = 2.0 / (layer.far - layer.near);
    at.slope = receiver_slope(layer, r.p_world, r.n_geometric) * (-per_metre / (stored_per_metre(layer, m.depth) * c.filtering.map.size));
    // where the light grazes, a receiver's plane leaves the map within a texel: no steeper than 50 metres a metre
    at.slope *= min(1.0, 50.0 * per_metre / max(length(at.slope / m.texel), 1e-20));
    // as reference_depth: what rounding may take
    const float rounding = stored_rounding(layer, m.z) / stored_per_metre(layer, m.depth);
    // and what means of up to 127 x 127 depths may be off by rounding, or a floor would stand behind its own mean
    at.t = centred_from_depth(layer, m.depth - rounding) - 1e-5 - c.filtering.params.bias * float(c.filtering.params.kernel) * (abs(at.slope.x) + abs(at.slope.y));
    return at;
}

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.filtering.view, c.filtering.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) return;
    const Layers layers = select_layers(
        c.filtering.map.layout_kind, c.filtering.map.centre, c.filtering.map.axes, c.filtering.map.splits, c.filtering.map.bands, r.p_world);
    visibility = 0.0;
    for (int i = 0; i < count_of(layers); ++i)
        visibility += share_of(layers, i) * filtered_visibility(filter_point(r, layers.first + i));
}

// The mean of the values of one group over the receiver's window. Between texels the windows' means are blended, which makes the window
// one of n + 1 texels with the fractions as the outer weights, as for overlapping bilinear taps. Summed-area tables have that window
// itself, or one as wide as the pixel's footprint where that is wider; mips are for footprints only.
vec4 window_mean(FilterPoint at, int group)
{
    const int layer = at.layer * c.filtering.groups + group;
    const float size = c.filtering.map.size;
    if (prefilter == PREFILTER_SUMS) {
        const vec2 footprint = size * (abs(at.dx) + abs(at.dy));
        const vec2 half_width = 0.5 * clamp(footprint, vec2(c.filtering.params.kernel), vec2(c.filtering.widest));
        return 2.0 * window_mean(sums_image, layer, at.uv * size - half_width, at.uv * size + half_width, c.filtering.sum_step) - 1.0;
    }
    const vec3 uv = vec3(at.uv + c.filtering.shift / size, float(layer));
    if (prefilter == PREFILTER_MIPS) return anisotropic_mean(means_image, layer, uv.xy, at.dx, at.dy, 8);
    return textureLod(means_image, uv, 0.0);
}

// The four windows that window_mean blends, i = 0 to 3, for means that must not be blended by the sampler.
struct WindowTexel {
    ivec2 texel;
    float weight;
};
WindowTexel window_texel(FilterPoint at, int i)
{
    const vec2 p = at.uv * c.filtering.map.size + c.filtering.shift - 0.5;
    const ivec2 e = ivec2(i & 1, i >> 1);
    const vec2 f = p - floor(p), w = mix(1.0 - f, f, vec2(e));
    return WindowTexel(clamp(ivec2(floor(p)) + e, ivec2(0), ivec2(c.filtering.map.size) - 1), w.x * w.y);
}

// (minimum, maximum) of a window_min_max over the same texels.
vec2 window_range(sampler2DArray pairs, FilterPoint at)
{
    vec2 range = vec2(1e30, -1e30);
    for (int i = 0; i < 4; ++i) {
        const WindowTexel w = window_texel(at, i);
        const vec2 pair = texelFetch(pairs, ivec3(w.texel, at.layer), 0).xy;
        if (w.weight > 0.0) range = vec2(min(range.x, pair.x), max(range.y, pair.y));
    }
    return range;
}

#endif
