// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

#include <array>
#include <vector>

namespace gnomon::techniques::per_triangle_volumes {

/// What one frame's passes share.
struct TreeBuffers {
    gpu::BufferId words, tiles, volumes, work, entries, kept, groups, counts;
    std::array<gpu::BufferId, 3> sums; ///< of the modes that add up: u32 for each node's child
    uint32_t room; ///< for entries
};
/// For so many volumes at a time, and a list of so many entries.
TreeBuffers make_buffers(gpu::PassList&, const shadow::Frame&, const shaders::Tree&, uint32_t volumes, uint32_t entries);

/// b.groups for a pass with a team, or a group, for each of a number in Work, of which no more than `most` count.
enum class WorkNumber : uint8_t { volumes, entries, blocks };
void find_groups(gpu::PassList&, const TreeBuffers& b, WorkNumber, uint32_t most, bool one_a_group);

/// A shader that includes traverse.glsl.
struct Traversal {
    const char* shader; ///< of this folder
    std::vector<gpu::SpecConstant> specialised;
    gpu::Constants constants;
    std::vector<gpu::Binding> bindings{}; ///< from 12 on
    bool teams_are_groups = false;
};
/// Takes all volumes down the tree.
void traverse(gpu::PassList&, const shadow::Frame&, const TreeBuffers&, const Traversal&);

/// Numbers that are added up where somebody asks for them, else nothing.
gpu::Binding counting(const shadow::Frame&, const TreeBuffers&);

} // namespace gnomon::techniques::per_triangle_volumes
