// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

// The numbers of the scenes that have closed forms (scene/analytic.h). The floor is y = 0.
namespace gnomon::scene::analytic_scenes {

/// half_plane: {x <= edge_x} at blocker_y. It ends `reach` metres from the origin on the other three sides: the closed form holds
/// for floor points within `valid` of the origin.
inline constexpr float half_plane_edge_x = 0.0f, half_plane_y = 2.0f, half_plane_reach = 30.0f;
/// rect_blocker: [min, max] in x, z.
inline const vec2 rect_blocker_min{-0.8f, -0.5f}, rect_blocker_max{0.8f, 0.5f};
inline constexpr float rect_blocker_y = 1.5f;
/// disk_blocker: a disk, drawn as a regular polygon of at least `disk_blocker_sides` corners on its circle; the polygon's area is
/// 2 pi^2 / (3 sides^2) = 1e-4 of the disk's below it, which bounds how far visibility departs from the closed form.
inline const vec2 disk_blocker_centre{0.0f, 0.0f};
inline constexpr float disk_blocker_radius = 0.7f, disk_blocker_y = 1.5f;
inline constexpr int disk_blocker_sides = 256;

inline constexpr float valid = 8.0f;

} // namespace gnomon::scene::analytic_scenes
