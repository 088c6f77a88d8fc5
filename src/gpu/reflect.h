// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/program.h"

#include <span>

namespace gnomon::gpu {

/// What one shader says of itself.
struct Reflection {
    std::vector<ReflectedBinding> bindings;
    uint32_t constants_bytes = 0;
    std::array<uint32_t, 3> local_size{1, 1, 1};
};

/// Throws std::logic_error where the shader leaves the descriptor convention of program.h.
Reflection reflect(const ShaderSource&, VkShaderStageFlagBits, std::span<const SpecConstant>);

/// By the end of the name: "techniques/pcss/pcss_resolve.frag" is a fragment shader.
VkShaderStageFlagBits stage_of(std::string_view shader);

/// Throws std::logic_error with the nearest names where there is none.
const ShaderSource& find_shader(std::string_view name);

} // namespace gnomon::gpu
