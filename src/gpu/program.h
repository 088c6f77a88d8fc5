// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <volk.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The one descriptor convention, read from SPIR-V:
//   set 0            the pass's bindings, in the order of the pass's list: list entry i is binding i
//   set 1 binding 0  the constants block: `layout(set = 1, binding = 0, scalar) uniform Constants { ... };`
//   set 2 binding 0  the scene's textures: `uniform sampler2D textures[];`
namespace gnomon::gpu {

struct SpecConstant {
    uint32_t id;
    uint32_t value; ///< bits (std::bit_cast a float)
};

struct HitShaders {
    std::string_view closest_hit, any_hit; ///< "" = none
};

/// A shader embedded in the library at build time. Generated table; see cmake/shaders.cmake.
struct ShaderSource {
    std::string_view name;
    std::span<const uint32_t> spirv;
};
std::span<const ShaderSource> embedded_shaders();

struct ReflectedBinding {
    uint32_t set, binding;
    VkDescriptorType type;
    uint32_t count; ///< 0 = runtime array
    VkShaderStageFlags stages;
    std::string name;
    VkImageViewType view = VK_IMAGE_VIEW_TYPE_MAX_ENUM; ///< images: what the shader declares
};

/// Shaders with their reflected interface; pipelines are made on first use. Owned by the device.
class Program {
public:
    virtual ~Program() = default;
    std::string name;
    std::vector<ReflectedBinding> bindings;
    uint32_t constants_bytes = 0; ///< size of the constants block; a pass that gives another size is refused
    std::array<uint32_t, 3> local_size{1, 1, 1}; ///< compute: dispatches take threads, not groups
};

} // namespace gnomon::gpu
