// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

#include <string>
#include <string_view>

// Vulkan's enums and Gnomon's as an export writes them.
namespace gnomon::lab {

std::string_view name_of(gpu::Use);
std::string_view name_of(gpu::Sampler);
std::string_view name_of(gpu::Load);
std::string_view name_of(VkCompareOp);
std::string_view name_of(VkStencilOp);
std::string_view name_of(VkBlendFactor);
std::string_view name_of(VkBlendOp);
std::string_view name_of(VkPrimitiveTopology);
std::string_view name_of(VkImageViewType);
std::string cull_name(VkCullModeFlags);

} // namespace gnomon::lab
