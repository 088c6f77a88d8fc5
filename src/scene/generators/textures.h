// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <functional>

// Small procedural pictures that tile. Colours are given in sRGB, 0 to 1.
namespace gnomon::scene::generators {

/// Paints a size x size texture from a function of (u, v) in [0, 1).
Texture painted(std::string name, int size, const std::function<vec4(vec2)>&);

/// Courses of cut stone in running bond with mortar joints: `rows` courses and `columns` stones a course over the tile.
Texture stone_blocks(std::string name, vec3 stone, vec3 mortar, int columns, int rows, uint32_t seed, float joint = 0.035f);
/// Rough single-colour stone, plaster or earth: `contrast` 0 to 1.
Texture mottled(std::string name, vec3 color, float contrast, int scale, uint32_t seed);
/// Boards along v.
Texture planks(std::string name, vec3 color, int boards, uint32_t seed);
/// Overlapping curved roof tiles in rows.
Texture roof_tiles(std::string name, vec3 color, int columns, int rows, uint32_t seed);
/// Woven cloth with stripes along v.
Texture striped_cloth(std::string name, vec3 a, vec3 b, int stripes, uint32_t seed);
/// A square grid of tiles, every other one in the second colour.
Texture checker_tiles(std::string name, vec3 a, vec3 b, int count, uint32_t seed);
/// Round cobbles on a jittered grid.
Texture cobbles(std::string name, vec3 stone, vec3 joint, int count, uint32_t seed);

// With an alpha channel
/// A spray of leaves for a leaf card; v = 0 is the twig's foot.
Texture leaf_spray(std::string name, vec3 color, uint32_t seed);
/// Upright grass blades from v = 1 (the ground) to v = 0; repeats in u.
Texture grass_blades(std::string name, vec3 color, uint32_t seed);
/// Diagonal wire mesh: `cells` diamonds a side over the tile.
Texture chain_link(std::string name, vec3 wire, int cells);

} // namespace gnomon::scene::generators
