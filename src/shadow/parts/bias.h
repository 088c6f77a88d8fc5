// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/bias.shared.h"
#include "shadow/parts/light_map.h"

// What keeps a surface from shadowing itself, for every technique that compares depths (docs/bias.md). Half of each kind is here, in the
// map; the other half, at the receiver, is shaders/bias.glsl.
namespace gnomon::shadow::parts {

/// `ids`: whether that kind is offered; its filter is the technique's own (shaders/ids.glsl).
void describe_bias(Fields&, shaders::BiasParams&, bool ids);

/// draw_light_map as the kind wants it. `reach`: texels between a receiver and the farthest centre of a texel that the filter reads.
///   slope: polygon offset of 0.75 * scale * 2 * reach
///   second_depth: back faces alone (Wang and Molnar 1994)
///   midpoint: half-way between the first two surfaces (Woo 1992); where there is one, b behind it
///   dual_layers: the same, b at most (Weiskopf and Ertl 2003)
/// with b = constant + scale * reach * texel. Maps of two layers have 32 bits whatever the format: rounded to 16, half of a surface would
/// lie behind itself, and be its own second layer.
LightMap draw_biased_map(gpu::PassList&, const Frame&, const LightMapSettings&, const shaders::BiasParams&, float reach);

/// Whose each texel of the map is. R32UI, layers as the map's: first_primitive of the instance; 0xffffffff where there is none.
gpu::ImageId draw_light_ids(gpu::PassList&, const Frame&, const LightMap&, const LightMapSettings&);

/// For shaders/ids.glsl: how many instances there are, then their first primitives, ascending.
gpu::Buffer instance_starts(gpu::Device&, const scene::Scene&);

} // namespace gnomon::shadow::parts
