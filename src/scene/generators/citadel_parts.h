// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/generators/builder.h"

// The parts of the citadel, a walled courtyard. Metres; the courtyard's middle is the origin, the gate is at -z.
namespace gnomon::scene::generators::citadel_parts {

inline constexpr float half_width = 17.0f, half_depth = 15.0f; ///< of the courtyard, to the inner faces of the walls
inline constexpr float wall_height = 6.0f, wall_depth = 1.8f;

struct Materials {
    int paving, grass, wall, dressed, dark_stone, plaster, timber, planks, roof, slate, iron, rope, hay, sack, dark;
    int red_cloth, blue_cloth, green_cloth, tent_cloth, leaves, bark, fruit_red, fruit_green, clay;
};
Materials make_materials(Stage&);

void add_ground(Stage&, const Materials&); ///< paved court with a slight relief, grass outside
void add_curtain_walls(Stage&, const Materials&);
void add_towers(Stage&, const Materials&);
void add_gate(Stage&, const Materials&);
void add_keep(Stage&, const Materials&);
void add_stairs(Stage&, const Materials&);
void add_houses(Stage&, const Materials&);
void add_market(Stage&, const Materials&); ///< stalls, well, cart, barrels, crates, tents
void add_greenery(Stage&, const Materials&);
void add_cloth(Stage&, const Materials&); ///< banners, flags, a line of pennants

/// A pitched roof over a w x d plan (metres, ridge along x) whose eaves are at y = 0: two tiled slabs with their undersides.
void add_gable_roof(MeshBuilder&, float w, float d, float height, float thickness);
/// Merlons along x from -length/2 to length/2 at y = 0.
void add_merlons(MeshBuilder&, float length, float depth);
/// A wall banner hanging down from y = 0, with a slight wave and a swallow tail: a sheet.
void add_banner(MeshBuilder&, float width, float height, float wave);

} // namespace gnomon::scene::generators::citadel_parts
