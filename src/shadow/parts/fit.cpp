// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/fit.h"

#include "shadow/parts/clip.h"
#include "shadow/parts/fit_point.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

mat4 light_axes(vec3 origin, vec3 direction, vec3 up)
{
    if (std::abs(glm::dot(direction, up)) > 0.999f) up = std::abs(direction.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1);
    const vec3 x = glm::normalize(glm::cross(direction, up)), y = glm::cross(x, direction);
    mat4 m(1);
    for (int c = 0; c < 3; ++c) m[c] = vec4(x[c], y[c], direction[c], 0);
    m[3] = vec4(-glm::dot(x, origin), -glm::dot(y, origin), -glm::dot(direction, origin), 1);
    return m;
}

std::vector<vec3> corners(const Bounds& b)
{
    std::vector<vec3> out;
    for (int i = 0; i < 8; ++i) out.push_back(vec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z));
    return out;
}

namespace {

Bounds in_axes(const std::vector<vec3>& points, const mat4& axes)
{
    Bounds out;
    for (const vec3 p : points) out.add(vec3(axes * vec4(p, 1)));
    return out;
}

} // namespace

float rim_factor(const LightMapSettings& settings)
{
    const float rim = std::max(2.0f, settings.guard_texels - 1.0f);
    return float(settings.size) / std::max(float(settings.size) - 2.0f * rim, 1.0f);
}

shaders::LightMapLayer orthographic_layer(const mat4& axes, vec2 centre, float extent, vec2 receivers, vec2 casters, int size)
{
    // Depths are compared to millionths of the range, and positions round to millionths of the scene's width: a flat scene gets a range
    // of a tenth of its width.
    const float depth = casters.y - casters.x;
    const float slack = std::max(1e-3f * depth, 0.5f * (0.1f * extent - depth));
    shaders::LightMapLayer layer{};
    layer.near = std::min(casters.x, receivers.x) - slack;
    layer.far = std::max(receivers.y, layer.near) + slack;
    mat4 clip(1);
    clip[0][0] = clip[1][1] = 2.0f / extent;
    clip[3][0] = -centre.x * 2.0f / extent, clip[3][1] = -centre.y * 2.0f / extent;
    clip[2][2] = -1.0f / (layer.far - layer.near), clip[3][2] = layer.far / (layer.far - layer.near);
    layer.map_from_world = uv_from_clip() * clip * axes;
    layer.depth_plane = row(axes, 2);
    layer.texel_metres = extent / float(size);
    layer.texel_uv = 1.0f / float(size);
    return layer;
}

shaders::LightMapLayer fit_parallel_layer(
    vec3 direction, const std::vector<vec3>& receivers, const std::vector<vec3>& casters, const LightMapSettings& settings)
{
    Bounds box;
    for (const vec3 p : casters) box.add(p);
    const mat4 axes = light_axes(box.centre(), direction, vec3(0, 1, 0));
    const Bounds seen = in_axes(receivers, axes), cast = in_axes(casters, axes);
    const float extent = std::max({seen.max.x - seen.min.x, seen.max.y - seen.min.y, 1e-4f}) * rim_factor(settings);
    return orthographic_layer(axes, vec2(seen.centre()), extent, {seen.min.z, seen.max.z}, {cast.min.z, cast.max.z}, settings.size);
}

namespace {

/// The one layer of `map`, focused, as its fit wants it. A spot has no cascades: of those that are warped it has the warp.
void warp(shaders::LightMap& map, const scene::View& view, const std::vector<vec3>& receivers, const LightMapSettings& settings)
{
    const Fit fit = Fit(settings.fitting.fit);
    if (fit == Fit::uniform || fit == Fit::focused || fit == Fit::cascades || fit == Fit::sdsm) return;
    const auto layer = warped_layer(map.layers[0], view, receivers, settings);
    if (layer)
        map.layers[0] = *layer;
    else
        map.fit_used = int(Fit::focused);
}

void fit_sun(shaders::LightMap& map, const Bounds& bounds, const scene::View& view, vec3 direction, const LightMapSettings& settings)
{
    const Fit fit = Fit(settings.fitting.fit);
    if (fit == Fit::cascades || fit == Fit::cascades_warped || fit == Fit::sdsm) {
        fit_cascades(map, bounds, view, direction, settings);
        return;
    }
    const std::vector<vec3> casters = corners(bounds);
    std::vector<vec3> receivers;
    if (fit != Fit::uniform) receivers = visible_part(view, bounds);
    map.layer_count = 1;
    map.layers[0] = fit_parallel_layer(direction, receivers.empty() ? casters : receivers, casters, settings);
    warp(map, view, receivers, settings);
}

} // namespace

shaders::LightMap fit_light_map(
    const scene::Scene&, const Bounds& bounds, const scene::View& view, const scene::Light& light, const LightMapSettings& settings)
{
    shaders::LightMap map{};
    map.size = float(settings.size);
    map.fit_used = settings.fitting.fit;
    map.depth_step = settings.format == DepthFormat::d16 ? 1.0f / 65535.0f : 0.0f;
    if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
        fit_sun(map, bounds, view, sun->direction, settings);
    } else if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape); spot && spot->outer_angle <= pi / 3.0f) {
        warp(map, view, fit_spot(map, bounds, view, *spot, settings), settings);
    } else if (spot) {
        fit_point(map, bounds, spot->position, settings);
    } else if (const auto* point = std::get_if<scene::PointLight>(&light.shape)) {
        fit_point(map, bounds, point->position, settings);
    } else if (const auto* rect = std::get_if<scene::RectLight>(&light.shape)) {
        const vec3 u = glm::normalize(rect->half_u), n = glm::normalize(glm::cross(rect->half_u, rect->half_v));
        fit_cube(map, bounds, rect->centre, mat3(u, glm::cross(n, u), n), settings);
    } else {
        const auto& disk = std::get<scene::DiskLight>(light.shape);
        fit_cube(map, bounds, disk.centre, scene::basis_about(disk.normal), settings);
    }
    return map;
}

} // namespace gnomon::shadow::parts
