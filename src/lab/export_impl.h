// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/describe.h"
#include "lab/export.h"
#include "lab/export_spirv.h"

#include <nlohmann/json.hpp>

// The parts of an export. All that it knows is one JSON value (passes.json); the README is that value in words.
namespace gnomon::lab {

using Json = nlohmann::ordered_json;

/// A shader with the values that its specialisation constants have where it is first used.
struct UsedShader {
    std::string name; ///< among the embedded ones
    VkShaderStageFlagBits stage;
    std::vector<gpu::SpecConstant> constants;
};

/// Bindings, blocks, stage inputs and outputs, specialisation constants, work group. Structs go into `types` by name, with the
/// comments that their members have in the sources.
Json reflect_shader(const UsedShader&, std::span<const uint32_t> spirv, const std::map<std::string, std::string>& sources, Json& types);

/// Where a language finds a resource of set and binding, as its text says it: "t3, space0 and s3, space0".
std::string place_of(Language, const Json& resource);

struct Translation {
    std::string text; ///< SPIR-V: the bytes
    std::string refusal; ///< not empty: why there is no text
};
Translation translate(Language, const UsedShader&, std::span<const uint32_t> spirv, const Json& reflection);

/// The values of a block's bytes by its members.
Json decode_block(std::span<const std::byte>, const Json& members, const Json& types);
/// The structs as a C++ header that needs nothing else, with an assertion for each offset.
std::string layout_header(const Json& types);

/// A technique's passes among those of a list.
struct Recording {
    Recording(const gpu::PassList&, const shadow::Frame&, std::string_view technique);
    const gpu::ListData& list;
    const shadow::Frame& frame;
    std::vector<const gpu::Pass*> passes;
    std::vector<std::string> names; ///< of the passes, without the technique's id
    std::vector<std::string> images, buffers; ///< names by index; no two alike
};
/// {"images": ..., "buffers": ...}: what the passes use, who makes it, which passes read and write it.
Json describe_resources(const Recording&);
/// `shaders` gathers those that the passes use.
Json describe_passes(const Recording&, std::vector<UsedShader>& shaders);
const gpu::Constants* constants_of(const gpu::Pass&);

std::string readme(const Json& recipe);

} // namespace gnomon::lab
