// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/light_map.shared.h"

#include <cmath>

/// shaders/light_map.glsl in double: what the fits and the shader are held to.
namespace gnomon::tests {

struct MapPoint {
    glm::dvec2 uv;
    double z, depth, w;
    bool inside;
    glm::dvec2 texel;
};

inline int select_layer(const shaders::LightMap& map, vec3 p_world)
{
    if (map.layout_kind == LIGHT_MAP_SINGLE) return 0;
    if (map.layout_kind == LIGHT_MAP_CASCADES) {
        const float depth = glm::dot(p_world - map.centre, map.axes[2]);
        int layer = 0;
        while (layer < 7 && depth > map.splits[layer / 4][layer % 4]) ++layer;
        return layer;
    }
    const vec3 d = (p_world - map.centre) * map.axes;
    if (map.layout_kind == LIGHT_MAP_DUAL_PARABOLOID) return d.y <= 0.0f ? 0 : 1;
    if (map.layout_kind == LIGHT_MAP_TETRAHEDRON) {
        const float along[] = {d.x + d.y + d.z, d.x - d.y - d.z, -d.x + d.y - d.z, -d.x - d.y + d.z};
        int most = 0;
        for (int i = 1; i < 4; ++i)
            if (along[i] > along[most]) most = i;
        return most;
    }
    int axis = 2;
    if (std::abs(d.y) >= std::abs(d[axis])) axis = 1;
    if (std::abs(d.x) >= std::abs(d[axis])) axis = 0;
    return 2 * axis + (d[axis] >= 0.0f ? 0 : 1);
}

/// The share of the next cascade.
inline double next_share(const shaders::LightMap& map, vec3 p_world)
{
    if (map.layout_kind != LIGHT_MAP_CASCADES) return 0.0;
    const int layer = select_layer(map, p_world);
    const double depth = double(glm::dot(p_world - map.centre, map.axes[2]));
    const double begin = double(map.bands[layer / 4][layer % 4]), end = double(map.splits[layer / 4][layer % 4]);
    return depth > begin ? (depth - begin) / (end - begin) : 0.0;
}

inline double stored_from_depth(const shaders::LightMapLayer& layer, double depth)
{
    const double near = double(layer.near), far = double(layer.far);
    return layer.perspective ? near / (far - near) * (far / depth - 1.0) : (far - depth) / (far - near);
}

inline double depth_from_stored(const shaders::LightMapLayer& layer, double z)
{
    const double near = double(layer.near), far = double(layer.far);
    return layer.perspective ? near * far / (z * (far - near) + near) : far - z * (far - near);
}

/// A paraboloid's point in closed form, without the tangent layer that the shader reads through.
inline MapPoint project_paraboloid(const shaders::LightMap& map, int index, vec3 p_world)
{
    const shaders::LightMapLayer& layer = map.layers[index];
    const glm::dvec3 d = glm::dvec3(p_world) - glm::dvec3(map.centre), z(layer.depth_plane);
    const glm::dmat4 m(layer.map_from_world);
    const glm::dvec3 x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]); // times the scale
    const double distance = glm::length(d), ahead = distance + glm::dot(d, z);
    MapPoint out{glm::dvec2(0.5) + glm::dvec2(glm::dot(d, x), glm::dot(d, y)) / ahead, 0, distance, distance, true, glm::dvec2(0)};
    out.z = stored_from_depth(layer, distance);
    // the map is conformal: (1 + rho^2) / 2 in angle for each unit of rho
    const double scale = glm::length(x), rho = glm::length(out.uv - 0.5) / scale;
    out.texel = glm::dvec2(double(layer.texel_uv) * distance * 2.0 / ((1.0 + rho * rho) * scale));
    return out;
}

inline MapPoint project(const shaders::LightMapLayer& layer, vec3 p_world)
{
    const glm::dvec4 p(glm::dvec3(p_world), 1.0), h = glm::dmat4(layer.map_from_world) * p;
    MapPoint m{glm::dvec2(h.x, h.y) / h.w, h.z / h.w, glm::dot(glm::dvec4(layer.depth_plane), p), h.w, false, {}};
    if (layer.warped) m.z = stored_from_depth(layer, m.depth);
    // metres across the axis by differences, in place of the shader's derivatives
    const glm::dmat4 rows = glm::transpose(glm::dmat4(layer.map_from_world));
    const glm::dvec3 axis(layer.depth_plane);
    for (int k = 0; k < 2; ++k) {
        glm::dvec3 gradient = (glm::dvec3(rows[k]) - m.uv[k] * glm::dvec3(rows[3])) / h.w;
        gradient -= glm::dot(gradient, axis) * axis;
        m.texel[k] = double(layer.texel_uv) / glm::length(gradient);
    }
    m.inside = h.w > 0.0 && m.uv.x >= 0.0 && m.uv.y >= 0.0 && m.uv.x <= 1.0 && m.uv.y <= 1.0;
    return m;
}

} // namespace gnomon::tests
