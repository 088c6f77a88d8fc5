// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene.h"

#include <functional>

namespace host {

struct PushConstants {
    Mat4 clip_from_host;
    float light_position[4], light_direction[4], up[4], cone[4]; ///< as in lit.frag
};
static_assert(sizeof(PushConstants) == 128); // what every device has room for

constexpr VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
VkFormat normals_format(Normals); ///< VK_FORMAT_UNDEFINED for none

/// The two passes over the scene's geometry: depth with normals, and the lit picture.
struct Pipelines {
    Pipelines(const Gpu&, const Scene&, const Convention&);
    void destroyers(const Gpu&, std::vector<std::function<void()>>& out);

    VkSampler sampler = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE; ///< 0: instances, 1: visibility
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline depth = VK_NULL_HANDLE, lit = VK_NULL_HANDLE;
};

} // namespace host
