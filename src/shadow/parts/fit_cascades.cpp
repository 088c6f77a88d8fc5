// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/fit.h"

#include "shadow/parts/clip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow::parts {

namespace {

vec2 depths_along(const std::vector<vec3>& points, vec3 axis, float origin)
{
    vec2 range(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());
    for (const vec3 p : points) {
        const float depth = glm::dot(p, axis) - origin;
        range = {std::min(range.x, depth), std::max(range.y, depth)};
    }
    return range;
}

/// The sphere about the part of the view's frustum between two depths, in view space: centre along the axis, and radius. It follows from
/// the view's projection alone, in the same bits wherever the view stands.
vec2 slice_sphere(const scene::View& view, float from, float to)
{
    const mat4& p = view.clip_from_view;
    // half the frustum's diagonal: at a depth of 1, or, orthographic, at every one
    const float slope = std::sqrt(1.0f / (p[0][0] * p[0][0]) + 1.0f / (p[1][1] * p[1][1]));
    const float a = view.orthographic ? slope : slope * from, b = view.orthographic ? slope : slope * to;
    // equally far from the corners at both ends, but not beyond the far end
    const float centre = std::clamp(0.5f * (from + to) + (b * b - a * a) / (2.0f * (to - from)), from, to);
    return {centre, std::sqrt((to - centre) * (to - centre) + b * b)};
}

shaders::LightMapLayer stable_layer(
    const scene::View& view, vec3 direction, const Bounds& bounds, vec2 slice, const LightMapSettings& settings)
{
    const mat4 axes = light_axes(bounds.centre(), direction, vec3(0, 1, 0));
    const vec2 depths = depths_along(corners(bounds), vec3(axes[0][2], axes[1][2], axes[2][2]), -axes[3][2]);
    const vec2 sphere = slice_sphere(view, slice.x, slice.y);
    // a texel more on each side, for the snapping
    const float extent = 2.0f * sphere.y * rim_factor(settings) * float(settings.size) / float(std::max(settings.size - 2, 1));
    const float texel = extent / float(settings.size);
    const vec2 centre(axes * vec4(view.eye + forward_of(view) * sphere.x, 1));
    return orthographic_layer(axes, glm::floor(centre / texel + 0.5f) * texel, extent, depths, depths, settings.size);
}

/// Each layer as lispsm has it; false where that is none. What a warp does not suit is drawn with the others, by one program.
bool warp_cascades(
    shaders::LightMap& map, const scene::View& view, const std::vector<std::vector<vec3>>& slices, const LightMapSettings& settings)
{
    bool any = false;
    for (size_t i = 0; i < slices.size(); ++i)
        if (const auto layer = warped_layer(map.layers[i], view, slices[i], settings)) map.layers[i] = *layer, any = true;
    for (size_t i = 0; any && i < slices.size(); ++i) map.layers[i].warped = 1;
    return any;
}

} // namespace

std::vector<float> cascade_ends(float near, float far, int count, float split, float nearest)
{
    std::vector<float> ends;
    nearest = std::clamp(nearest, near, far);
    for (int i = 1; i <= count; ++i) {
        const float part = float(i) / float(count);
        const float even = near + part * (far - near);
        ends.push_back(
            split > 0.0f ? glm::mix(even, nearest * std::pow(far / nearest, part), split) : even); // `near` may be 0 where it is even
    }
    return ends;
}

void fit_cascades(shaders::LightMap& map, const Bounds& bounds, const scene::View& view, vec3 direction, const LightMapSettings& settings)
{
    const bool stable = settings.fitting.stable != 0 && Fit(settings.fitting.fit) == Fit::cascades;
    const std::vector<vec3> casters = corners(bounds);
    std::vector<vec3> seen = visible_part(view, bounds);
    if (seen.empty()) seen = casters;
    const vec3 forward = forward_of(view);
    const float eye = glm::dot(forward, view.eye);
    vec2 range = depths_along(seen, forward, eye);
    // What stays where it is while the view moves: the near plane, and as far as the scene is wide; from outside, steps of that.
    if (stable) {
        const float step = 2.0f * std::max(bounds.radius(), 1e-3f);
        range = {std::min(view.near, step * std::floor(range.x / step)), step * std::max(1.0f, std::ceil(range.y / step))};
    }
    // of an orthographic view all texels are alike, before the eye and behind it
    const float split = view.orthographic ? 0.0f : settings.fitting.split;
    if (!view.orthographic) range.x = std::max(range.x, view.near);
    range.y = std::max(range.y, range.x + 1e-4f * std::max(bounds.radius(), 1e-3f));

    const int count = std::clamp(settings.fitting.cascades, 1, LIGHT_MAP_MAX_LAYERS);
    const std::vector<float> ends = cascade_ends(range.x, range.y, count, split, settings.fitting.nearest);
    map.layout_kind = LIGHT_MAP_CASCADES, map.layer_count = uint32_t(count), map.centre = view.eye;
    map.axes = mat3(0);
    map.axes[2] = forward;
    for (int i = 0; i < LIGHT_MAP_MAX_LAYERS; ++i) {
        float begin = std::numeric_limits<float>::max(), end = begin;
        if (i < count - 1) end = ends[size_t(i)], begin = glm::mix(end, i == 0 ? range.x : ends[size_t(i - 1)], settings.fitting.blend);
        map.splits[i / 4][i % 4] = end, map.bands[i / 4][i % 4] = begin;
    }
    std::vector<std::vector<vec3>> slices; // what each layer's receivers lie within
    for (int i = 0; i < count; ++i) {
        const vec2 slice(i == 0 ? range.x : map.bands[(i - 1) / 4][(i - 1) % 4], ends[size_t(i)]);
        if (stable) {
            map.layers[i] = stable_layer(view, direction, bounds, slice, settings);
            continue;
        }
        const std::vector<vec3> receivers = visible_part(view, bounds, slice.x, slice.y);
        map.layers[i] = fit_parallel_layer(direction, receivers.empty() ? seen : receivers, casters, settings);
        slices.push_back(receivers.empty() ? seen : receivers);
    }
    if (Fit(settings.fitting.fit) == Fit::cascades_warped && !warp_cascades(map, view, slices, settings)) map.fit_used = int(Fit::cascades);
    if (Fit(settings.fitting.fit) == Fit::sdsm) map.fit_used = int(Fit::cascades); // unless fit_to_samples takes over
}

} // namespace gnomon::shadow::parts
