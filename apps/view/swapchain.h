// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "gpu/functions.h"
#include "gpu/pass_list.h"

#include <functional>
#include <vector>

namespace gnomon::view {

/// Shows pass lists in a window. One frame is on its way at a time: what a frame uses may be changed after `wait`.
class Swapchain {
public:
    /// Takes the surface over. Throws base::Error where the device cannot show anything on it.
    Swapchain(gpu::Device&, VkSurfaceKHR);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    using Draw = std::function<void(gpu::PassList&, gpu::ImageId target)>;
    /// False where nothing was shown: the window has no size, or has changed it in between; then ask again.
    bool present(base::Size window, const Draw&);
    void wait(); ///< until the frame on its way is over
    base::Size size() const { return size_; }

private:
    struct SurfaceFunctions {
        PFN_vkDestroySurfaceKHR destroy;
        PFN_vkGetPhysicalDeviceSurfaceSupportKHR support;
        PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR capabilities;
        PFN_vkGetPhysicalDeviceSurfaceFormatsKHR formats;
    };
    bool make(base::Size window);
    void drop();
    void wait_and_drop();
    void choose_format();
    VkSemaphore semaphore();
    void record(uint32_t index, const Draw&);
    bool submit(uint32_t index);

    gpu::Device& device_;
    VolkDeviceTable vk_{};
    SurfaceFunctions surface_vk_{};
    VkSurfaceKHR surface_;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR handle_ = VK_NULL_HANDLE;
    base::Size size_;
    std::vector<gpu::Image> images_;
    std::vector<VkSemaphore> drawn_; ///< one an image: an image's is free again when the image is
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    uint64_t ticket_ = 0; ///< of the frame on its way; 0 = none
};

} // namespace gnomon::view
