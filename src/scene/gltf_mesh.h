// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_material.h"
#include "scene/scene.h"

namespace gnomon::scene::gltf {

/// What a node does to the primitives of its mesh.
struct Deformation {
    std::vector<float> weights; ///< of the morph targets; missing ones are 0
    std::vector<mat4> world_from_joint; ///< joint matrix times inverse bind matrix; empty: no skin
};

/// Reads a primitive, in object space, or in world space where it has a skin. Throws DataError, also where no triangle is left.
Mesh read_primitive(Document&, Materials&, const Value& primitive, const Deformation&);

/// Adds the weighted morph targets.
void apply_morph(Document&, const Value& primitive, std::span<const float> weights, Mesh&);
/// Bends the vertices by their joints.
void apply_skin(Document&, const Value& primitive, std::span<const mat4> world_from_joint, Mesh&);

/// `indices` of a strip (glTF mode 5) or fan (6) as those of a list; a list (4) is cut to whole triangles.
void to_triangle_list(uint64_t mode, std::vector<uint32_t>& indices);
/// Removes triangles with two equal indices, and those with a position that is not finite or absurdly far; the count of the latter.
size_t drop_bad_triangles(Mesh&);
/// Unit normals: one for each face where there were none (glTF asks for flat shading), smooth ones in place of broken ones.
void finish_normals(Mesh&);
/// Removes the vertices that no triangle uses: several primitives may share one large array.
void drop_unused_vertices(Mesh&);
/// The mesh as its mirror image in x, its faces still counter-clockwise seen from outside.
void mirror_x(Mesh&);

/// Beyond this many metres squared lengths near the end of the range of float: taken for garbage.
inline constexpr float farthest = 1e15f;

} // namespace gnomon::scene::gltf
