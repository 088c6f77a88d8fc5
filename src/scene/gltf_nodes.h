// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace gnomon::scene::gltf {

/// Transforms are composed in double: deep hierarchies and far-off places lose millimetres in float.
using glm::dmat4;
using glm::dquat;
using glm::dvec3;

struct Node {
    int parent = -1;
    std::vector<size_t> children;
    bool has_matrix = false; ///< then `matrix` counts, else the three below
    dmat4 matrix{1};
    dvec3 translation{0}, scale{1};
    dquat rotation{1, 0, 0, 0};
    std::vector<float> weights; ///< of morph targets; empty: those of the mesh
    dmat4 world{1};
};

/// All nodes with their own transforms. A node in a loop or with a second parent is cut off there, with a warning.
std::vector<Node> read_nodes(Document&);

/// Sets translations, rotations, scales and weights to their values at `time`: every animation of the file plays, in its order,
/// and repeats after its last key.
void animate(Document&, std::vector<Node>&, double time);
double animation_seconds(Document&); ///< of the longest animation; 0: there is none

/// Fills Node::world.
void compose(std::vector<Node>&);

/// The nodes of a scene (-1: the file's default) with all below them, parents first.
std::vector<size_t> nodes_of_scene(Document&, const std::vector<Node>&, int scene);

/// translation * rotation * scale.
dmat4 composed(dvec3 translation, dquat rotation, dvec3 scale);

/// What the joints of a skin do to a vertex: joint's world matrix times inverse bind matrix.
std::vector<mat4> joint_matrices(Document&, const Value& skin, const std::vector<Node>&);

/// The node's light (KHR_lights_punctual) and camera, where it has them.
void add_light(Document&, const Value& node, const dmat4& world, Scene&);
void add_camera(Document&, const Value& node, const dmat4& world, Scene&);

} // namespace gnomon::scene::gltf
