// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/clip.h"
#include "shadow/parts/light_map.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

// uv in [0,1] with v down, from clip coordinates with y up
const mat4 uv_from_clip = glm::translate(mat4(1), vec3(0.5f, 0.5f, 0)) * glm::scale(mat4(1), vec3(0.5f, -0.5f, 1));

/// World to a light's axes: x, y across, z along its direction (depth in metres).
mat4 light_axes(vec3 origin, vec3 direction, vec3 up)
{
    if (std::abs(glm::dot(direction, up)) > 0.999f) up = std::abs(direction.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1);
    const vec3 x = glm::normalize(glm::cross(direction, up)), y = glm::cross(x, direction);
    mat4 m(1);
    for (int c = 0; c < 3; ++c) m[c] = vec4(x[c], y[c], direction[c], 0);
    m[3] = vec4(-glm::dot(x, origin), -glm::dot(y, origin), -glm::dot(direction, origin), 1);
    return m;
}

vec4 row(const mat4& m, int r) { return vec4(m[0][r], m[1][r], m[2][r], m[3][r]); }

std::vector<vec3> corners(const Bounds& b)
{
    std::vector<vec3> out;
    for (int i = 0; i < 8; ++i) out.push_back(vec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z));
    return out;
}

Bounds in_axes(const std::vector<vec3>& points, const mat4& axes)
{
    Bounds out;
    for (const vec3 p : points) out.add(vec3(axes * vec4(p, 1)));
    return out;
}

/// How much wider a single layer is than its receivers: a rim, so that the outermost ones still have neighbours to filter.
float rim_factor(const LightMapSettings& settings)
{
    const float rim = std::max(2.0f, settings.guard_texels - 1.0f);
    return float(settings.size) / std::max(float(settings.size) - 2.0f * rim, 1.0f);
}

/// One orthographic layer around `receivers`; depth from the first caster to the last receiver.
shaders::LightMapLayer orthographic_layer(
    const mat4& axes, const Bounds& receivers, const Bounds& casters, const LightMapSettings& settings)
{
    const int size = settings.size;
    const float extent = std::max({receivers.max.x - receivers.min.x, receivers.max.y - receivers.min.y, 1e-4f}) * rim_factor(settings);
    const vec3 centre = receivers.centre();
    // Depths are compared to millionths of the range, and positions round to millionths of the scene's width: a flat scene gets a range
    // of a tenth of its width.
    const float depth = casters.max.z - casters.min.z;
    const float slack = std::max(1e-3f * depth, 0.5f * (0.1f * extent - depth));
    shaders::LightMapLayer layer{};
    layer.near = std::min(casters.min.z, receivers.min.z) - slack;
    layer.far = std::max(receivers.max.z, layer.near) + slack;
    mat4 clip(1);
    clip[0][0] = clip[1][1] = 2.0f / extent;
    clip[3][0] = -centre.x * 2.0f / extent, clip[3][1] = -centre.y * 2.0f / extent;
    clip[2][2] = -1.0f / (layer.far - layer.near), clip[3][2] = layer.far / (layer.far - layer.near);
    layer.map_from_world = uv_from_clip * clip * axes;
    layer.depth_plane = row(axes, 2);
    layer.texel_metres = extent / float(size);
    return layer;
}

/// One perspective layer: reversed depth with both planes fitted to the scene. `tangent`: of the half angle.
shaders::LightMapLayer perspective_layer(const mat4& axes, float tangent, float near, float far, int size)
{
    shaders::LightMapLayer layer{};
    layer.perspective = 1, layer.near = near, layer.far = far;
    mat4 clip(0);
    clip[0][0] = clip[1][1] = 1.0f / tangent;
    clip[2][2] = -near / (far - near), clip[3][2] = near * far / (far - near);
    clip[2][3] = 1.0f;
    layer.map_from_world = uv_from_clip * clip * axes;
    layer.depth_plane = row(axes, 2);
    layer.texel_metres = 2.0f * tangent / float(size);
    return layer;
}

/// Distances between which anything can cast or receive, for a light at `position`.
void depth_range(const Bounds& bounds, vec3 position, float& near, float& far)
{
    far = 0;
    for (const vec3 c : corners(bounds)) far = std::max(far, glm::length(c - position));
    far = std::max(far, 1e-3f) * 1.01f;
    const vec3 nearest = glm::clamp(position, bounds.min, bounds.max);
    // along an axis the depth can be as small as 1/sqrt(3) of the distance; inside the scene nothing bounds it: float depth reversed
    // loses no precision to a small near plane
    near = std::max(0.5f * glm::length(nearest - position), 2e-4f * far);
}

void fit_directional(
    shaders::LightMap& map, const Bounds& bounds, const scene::View& view, vec3 direction, const LightMapSettings& settings)
{
    const mat4 axes = light_axes(bounds.centre(), direction, vec3(0, 1, 0));
    const Bounds casters = in_axes(corners(bounds), axes);
    Bounds receivers = casters;
    if (settings.fit == Fit::view) {
        const std::vector<vec3> seen = visible_part(view, bounds);
        if (!seen.empty()) receivers = in_axes(seen, axes);
    }
    map.layer_count = 1;
    map.layers[0] = orthographic_layer(axes, receivers, casters, settings);
}

/// `axes`: the cube's, columns in world space.
void fit_cube(shaders::LightMap& map, const Bounds& bounds, vec3 position, const mat3& axes, const LightMapSettings& settings)
{
    // a face of 90 degrees plus a rim of guard texels: tan = 1 on (size - 2 guard) texels
    const float tangent = float(settings.size) / std::max(float(settings.size) - 2.0f * settings.guard_texels, 1.0f);
    float near, far;
    depth_range(bounds, position, near, far);
    map.layout_kind = LIGHT_MAP_CUBE, map.layer_count = 6, map.centre = position, map.axes = axes;
    for (int face = 0; face < 6; ++face) {
        const vec3 direction = axes[face / 2] * (face % 2 ? -1.0f : 1.0f);
        const vec3 up = axes[face / 2 == 1 ? 0 : 1];
        map.layers[face] = perspective_layer(light_axes(position, direction, up), tangent, near, far, settings.size);
    }
}

} // namespace

shaders::LightMap fit_light_map(
    const scene::Scene&, const Bounds& bounds, const scene::View& view, const scene::Light& light, const LightMapSettings& settings)
{
    shaders::LightMap map{};
    map.size = float(settings.size);
    map.depth_step = settings.format == DepthFormat::d16 ? 1.0f / 65535.0f : 0.0f;
    if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
        fit_directional(map, bounds, view, sun->direction, settings);
    } else if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape); spot && spot->outer_angle <= pi / 3.0f) {
        float near, far;
        depth_range(bounds, spot->position, near, far);
        map.layer_count = 1, map.centre = spot->position;
        map.layers[0] = perspective_layer(light_axes(spot->position, spot->direction, vec3(0, 1, 0)),
            std::tan(spot->outer_angle) * rim_factor(settings), near, far, settings.size);
    } else if (spot) {
        fit_cube(map, bounds, spot->position, mat3(1), settings);
    } else if (const auto* point = std::get_if<scene::PointLight>(&light.shape)) {
        fit_cube(map, bounds, point->position, mat3(1), settings);
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
