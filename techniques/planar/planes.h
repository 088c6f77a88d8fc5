// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <vector>

namespace gnomon::techniques::planar {

/// dot(equation, (p, 1)) is the signed distance in metres; which side is positive means nothing.
struct Plane {
    glm::dvec4 equation;
    double area = 0; ///< of the triangles on it, square metres
};

/// How far off a plane a point may lie and be on it: some rounding errors of the scene's coordinates.
double plane_thickness(const scene::Scene&);

/// The planes that hold most of the scene's opaque and masked surface, largest first: at most `count`, each with at least the fraction
/// `smallest` of all area. A triangle is on a plane when its corners are within half of `plane_thickness` of it, and counts for one plane
/// only.
std::vector<Plane> find_planes(const scene::Scene&, int count, double smallest);

} // namespace gnomon::techniques::planar
