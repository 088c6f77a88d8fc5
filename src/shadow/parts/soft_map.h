// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/soft_map.shared.h"
#include "shadow/parts/light_map.h"

#include <span>
#include <string_view>
#include <vector>

// What soft shadow methods that look at one light map share: its parameters, its drawing, and the pass that writes the result.
namespace gnomon::shadow::parts {

/// Describes the shared parameters; maps have up to `largest` texels a side.
void describe_soft(Fields&, shaders::SoftParams&, int largest = 4096);

struct SoftMap {
    LightMap map;
    shaders::SoftResolve constants; ///< for shaders/soft_map.glsl
};

/// How the light map is fitted: with a rim of an eighth of its side for windows that reach over the receivers.
LightMapSettings soft_map_settings(const shaders::SoftParams&);

/// The constants of a map so fitted, for those who draw it themselves.
shaders::SoftResolve soft_constants(const Frame&, const shaders::LightMap&, const shaders::SoftParams&);

/// Draws the light map from the light's centre.
SoftMap draw_soft_map(gpu::PassList&, const Frame&, const shaders::SoftParams&);

/// The full-screen pass that writes frame.output. Bindings 0 and 1 are those of shaders/soft_map.glsl; `more` follow. The constants begin
/// with soft_constants of the map. `estimates`: the shader calls estimate_penumbra, so that there is one to leave in Frame::inspections.
void resolve_soft(gpu::PassList&, const Frame&, const LightMap&, std::string_view shader, std::span<const gpu::SpecConstant>,
    gpu::Constants, std::vector<gpu::Binding> more, bool estimates = false);

} // namespace gnomon::shadow::parts
