// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/shadow/parts/caster_blocks.shared.h"
#include "techniques/per_triangle_volumes/traversal.h"

#include <span>
#include <vector>

// What semitransparent casters do, and how many samples a pixel has.
namespace gnomon::techniques::per_triangle_volumes {

void describe_modes(Params&, shadow::Fields&);
shadow::Output output_of(std::span<const std::byte> params);

/// All triangles of a scene in blocks: first those that always block, then those that block except where semitransparent casters are told
/// apart (opaque glass), then those that cast only there (blended).
struct CasterRanges {
    std::vector<shaders::CasterBlock> blocks;
    uint32_t solid = 0, opaque = 0; ///< ends of the first two parts
};
CasterRanges caster_ranges(const shadow::SceneGpu&);

/// The sums, all 0, or none. Throws Error where they are more than the device can bind.
void make_sums(gpu::PassList&, const shaders::Tree&, const Params&, TreeBuffers&);

/// The volumes in `b` are those of semitransparent triangles: adds what each takes away.
void traverse_clear(gpu::PassList&, const shadow::Frame&, const shaders::Tree&, const Params&, const TreeBuffers& b);
/// Writes the mean of each pixel's samples.
void resolve_samples(gpu::PassList&, const shadow::Frame&, const shaders::Tree&, const Params&, const TreeBuffers& b);

/// Of the samples of a pixel, right and down.
uvec2 samples_log2(const Params&);
/// The same picture with a pixel for each sample that has a depth of its own.
scene::View finer_view(scene::View, const Params&);
/// And its surfaces: drawn again, or with slopes beside their depths.
shadow::GBuffer finer_surfaces(gpu::PassList&, const shadow::Frame&, const scene::View& finer, const Params&);

} // namespace gnomon::techniques::per_triangle_volumes
