// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/prefiltered_soft.shared.h"
#include "shadow/parts/filtered_map.h"
#include "shadow/parts/soft_map.h"

// What soft shadow methods share that read averages over windows of one light map, of any width at one cost, in place of its texels.
namespace gnomon::shadow::parts {

/// Describes the shared parameters; maps have up to `largest` texels a side.
void describe_prefiltered_soft(Fields&, shaders::PrefilteredSoftParams&, int largest = 4096);

struct PrefilteredSoftMap {
    SoftMap soft;
    gpu::ImageId range; ///< pyramid of least and greatest depth
    shaders::PrefilteredSoft constants; ///< for shaders/prefiltered_soft.glsl
};

/// Draws the light map and its pyramid.
PrefilteredSoftMap draw_prefiltered_soft(gpu::PassList&, const Frame&, const shaders::PrefilteredSoftParams&);

/// The summed-area table of the values that `pass` makes of each texel's depth: array, layer of the map * groups + group. Integers as
/// precise as the widest window allows, of values in [0, 1], or floats.
gpu::ImageId sum_values(gpu::PassList&, const PrefilteredSoftMap&, const shaders::PrefilteredSoftParams&, const ValuesPass&);

/// The full-screen pass that writes frame.output. Bindings 0 to 3 are those of shaders/prefiltered_soft.glsl; `more` follow.
void resolve_prefiltered_soft(gpu::PassList&, const Frame&, const PrefilteredSoftMap&, std::string_view shader,
    std::span<const gpu::SpecConstant>, gpu::Constants, std::vector<gpu::Binding> more);

} // namespace gnomon::shadow::parts
