// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"

// Closed forms for the analytic built-in scenes: the floor is y = 0; blockers are parallel to it.
// Visibility is as in docs/conventions.md: the fraction of the light's area that the point sees.
namespace gnomon::scene::analytic {

/// half_plane: an opaque half-plane {x <= edge_x} at height `blocker_y` between the floor point `p` and a rectangle or disk light
/// parallel to the floor. Rectangle (axis-aligned): a linear ramp. Disk: the area of a circular segment.
double half_plane_visibility(const Light&, vec3 p, double edge_x, double blocker_y);

/// rect_blocker: an axis-aligned rectangle [min, max] in x, z at height y; axis-aligned rectangle light parallel to it.
/// The blocker projected from p onto the light's plane, clipped to the light, area over area.
double rect_visibility(const RectLight&, vec3 p, vec2 blocker_min, vec2 blocker_max, double blocker_y);

/// disk_blocker: a disk at height y before a disk light, both parallel to the floor: lens area of two circles.
double disk_visibility(const DiskLight&, vec3 p, vec2 blocker_centre, double blocker_radius, double blocker_y);

} // namespace gnomon::scene::analytic
