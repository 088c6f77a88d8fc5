// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"

#include <array>

// What a warp is made of, in double precision: shared by the files that warp layers.
namespace gnomon::shadow::parts::warp {

using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// World to a map: horizontal and vertical coordinate, and w.
using Rows = std::array<dvec4, 3>;

inline dvec4 row(const mat4& m, int r) { return {m[0][r], m[1][r], m[2][r], m[3][r]}; }

inline Rows rows_of(const shaders::LightMapLayer& layer)
{
    return {row(layer.map_from_world, 0), row(layer.map_from_world, 1), row(layer.map_from_world, 3)};
}

inline dvec3 at(const Rows& rows, const dvec4& p) { return {glm::dot(rows[0], p), glm::dot(rows[1], p), glm::dot(rows[2], p)}; }
inline dvec3 at(const Rows& rows, vec3 p) { return at(rows, dvec4(dvec3(p), 1.0)); }

inline dvec3 across(dvec3 v, dvec3 axis) { return v - axis * (glm::dot(v, axis) / glm::dot(axis, axis)); }

/// The gradient of the k-th coordinate in the world.
inline dvec3 gradient(const Rows& rows, int k, vec3 p)
{
    const dvec3 h = at(rows, p);
    return (dvec3(rows[size_t(k)]) - dvec3(rows[2]) * (h[k] / h.z)) / h.z;
}

/// Depth along the view's axis.
inline double depth_in(const scene::View& view, vec3 p) { return glm::dot(dvec3(forward_of(view)), dvec3(p) - dvec3(view.eye)); }

/// Perspective shadow maps (Stamminger, Drettakis 2002): the view's own projection makes a cube of what is seen and a point, mostly, of the
/// light; the map is a picture of the cube from that point, along the axis of the least cone around the receivers (Kozlov 2004). `slide`:
/// how far behind the eye the view is taken from, in depths of the deepest receiver. None where the light lies among them in the cube.
std::optional<Rows> view_of_cube(const shaders::LightMapLayer& focused, const scene::View&, const std::vector<vec3>& points, double slide);

} // namespace gnomon::shadow::parts::warp
