// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/generators/builder.h"
#include "scene/generators/noise.h"

namespace gnomon::scene::generators {

struct TreeShape {
    uint32_t seed = 1;
    float trunk = 2.6f, radius = 0.3f; ///< length to the top of the bole and its radius, metres
    int levels = 3; ///< of branching above the trunk
    int branches = 7; ///< on the trunk; the further levels have fewer
    float spread = 55.0f; ///< degrees between a branch and its parent
    float reach = 0.72f; ///< length of a branch over its parent's
    float lift = 0.25f; ///< how much branches turn towards the sky (negative: they droop)
};

/// A place for a leaf or a spray of leaves: where it is fastened and which way the twig grows.
struct Twig {
    vec3 foot, along;
};
/// Builds trunk and branches on y = 0 and returns where leaves grow, `per_twig` on each last branch.
std::vector<Twig> grow_tree(MeshBuilder& wood, const TreeShape&, int per_twig);

/// A textured card (a sheet), bent once along its middle; its normals lean outwards from `crown`, so that the tree is lit as one body.
void add_leaf_card(MeshBuilder&, const Twig&, float size, vec3 crown, Random&);
/// A single pointed leaf of two triangles, without need of a texture.
void add_leaf(MeshBuilder&, const Twig&, float size, vec3 crown, Random&);
/// Upright crossed cards of grass within `radius` of the origin, on height 0.
void add_grass(MeshBuilder&, int count, float radius, float height, Random&);
/// An irregular stone of about the given half sizes on y = 0.
void add_rock(MeshBuilder&, vec3 half, int around, uint32_t seed);

} // namespace gnomon::scene::generators
