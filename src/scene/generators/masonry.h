// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/generators/builder.h"

// Parts of buildings that more than one scene uses. Walls lie in the plane of x and y, centred on x = 0 and z = 0.
namespace gnomon::scene::generators {

/// The outline of an opening's head from its right springing over the top to its left: `rise` 0.5 = round, 0.866 = equilateral pointed.
std::vector<vec2> arch_head(float width, float spring, float rise, int count);

struct ArchedWall {
    float width = 4, bottom = 0, top = 6, depth = 0.6f;
    float opening = 1.6f, sill = 0, spring = 3, rise = 0.866f;
};
/// A wall with one arched opening; sill = bottom leaves a passage.
void add_arched_wall(MeshBuilder&, const ArchedWall&);
/// A moulding around the same opening, proud of the wall by `proud` and `thick` wide.
void add_arch_moulding(MeshBuilder&, const ArchedWall&, float thick, float proud);

/// A column of given height on y = 0: square plinth, moulded base, tapering shaft, capital.
void add_column(MeshBuilder&, float radius, float height, int around);

} // namespace gnomon::scene::generators
