// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <vector>

// The host's own Vulkan: one device, one queue, plain allocations. An engine has all of this already.
namespace host {

/// Throws std::runtime_error with what failed.
void check(VkResult, const char* what);

struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;
};

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

class Gpu {
public:
    /// `instance_extensions`: those of the window, whose surface `make_surface` then makes; without a window both are empty.
    Gpu(bool validation, const std::vector<const char*>& instance_extensions, const std::function<VkSurfaceKHR(VkInstance)>& make_surface);
    ~Gpu(); ///< destroys device and instance; all that was made of them is gone by then
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    std::vector<const char*> extensions; ///< of the device, as enabled
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE; ///< an engine loads it from a file and saves it there
    std::vector<std::string> messages; ///< of the validation layer

    /// Host-visible: this scene is small. `bytes` are written where `data` is given.
    Buffer buffer(VkDeviceSize bytes, VkBufferUsageFlags, const void* data = nullptr) const;
    Image image(VkFormat, VkExtent2D, VkSampleCountFlagBits, VkImageUsageFlags) const;
    bool can_be(VkFormat, VkFormatFeatureFlags) const;
    void destroy(const Buffer&) const;
    void destroy(const Image&) const;

private:
    void make_instance(bool validation, std::vector<const char*> extensions);
    bool take_device(VkPhysicalDevice); ///< false where it lacks what the host or Gnomon needs
    VkDeviceMemory allocate(const VkMemoryRequirements&, VkMemoryPropertyFlags) const;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::string refusals_; ///< why devices were not taken
};

} // namespace host
