// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/program.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Small changes to SPIR-V that give SPIRV-Cross something that the other language can say, and what the module's debug part holds.
namespace gnomon::lab {

using Words = std::vector<uint32_t>;

/// Path from the sources' root -> text, of the shader and all that it includes.
std::map<std::string, std::string> sources_of(std::span<const uint32_t>, std::string_view shader);

/// Without sources and lines; names stay.
Words without_sources(std::span<const uint32_t>);

/// These values become the defaults of the specialisation constants.
void set_defaults(Words&, std::span<const gpu::SpecConstant>);

/// HLSL packs constant buffers by rules of its own, which cannot say a scalar layout: as read-only storage their bytes can lie anywhere.
void uniforms_to_storage(Words&);

/// HLSL by SPIRV-Cross writes no layer outside of geometry shaders: an output like any other, whose semantic is put right in the text.
inline constexpr uint32_t layer_location = 31;
void layer_to_location(Words&);

/// SPIRV-Cross refuses to gather integers in HLSL, which can: as images of floats they pass, and the text is put right.
void integers_to_floats(Words&);

/// HLSL knows neither the number of waves in a group nor a wave's own: both follow from the lanes of a wave, where waves fill a group in
/// order.
void waves_from_lanes(Words&, uint32_t group_size);

/// SPIRV-Cross asserts on arrays without a size in MSL, and argument buffers are structs of fixed ones: the texture table gets a size.
inline constexpr uint32_t table_size = 128;
void give_table_size(Words&);

} // namespace gnomon::lab
