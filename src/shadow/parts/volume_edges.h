// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/shadow/parts/volumes.shared.h"

#include <span>
#include <vector>

namespace gnomon::shadow::parts {

/// The edges of a mesh, each once, with all triangles beside it, however many and whichever way they are wound. Vertices at one position
/// are one, so that seams of normals or texture coordinates are no borders.
struct MeshEdges {
    std::vector<shaders::VolumeEdge> edges;
    std::vector<uint32_t> list; ///< triangles beside edges that have more than two
};

/// Triangles two of whose corners are one bound nothing, and are left out.
MeshEdges mesh_edges(std::span<const vec3> positions, std::span<const uint32_t> indices);

} // namespace gnomon::shadow::parts
