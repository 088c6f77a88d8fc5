// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

// Floats have 24 bits: at 1e5 m their steps are 8 mm. A scene that lies far from the origin is therefore moved to it before anything is
// computed, once, in double precision; everything behind works in small coordinates.
namespace gnomon::scene {

/// Where the coordinates of a scene are best counted from: (0, 0, 0), unless its centre is more than sixteen times its radius away; then a
/// point near the centre whose coordinates have few bits, so that differences to it are exact.
vec3 far_origin(const Scene&);

/// Counts instances, lights and cameras of the scene from `origin`. Meshes whose own coordinates are far are moved too, and their instances
/// against them.
void rebase(Scene&, vec3 origin);

/// As without `origin`, for lists and bounds that are counted from there, and so is the result; the text is not, and is read in double
/// precision.
Light parse_light(std::string_view text, const std::vector<Light>& known, const Bounds& bounds, vec3 origin);
Camera parse_camera(std::string_view text, const std::vector<Camera>& known, const Bounds& bounds, vec3 origin);

} // namespace gnomon::scene
