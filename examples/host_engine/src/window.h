// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vulkan.h"

#include <array>

struct GLFWwindow;

namespace host {

/// A window and its swapchain, by GLFW.
class Window {
public:
    Window(uint32_t width, uint32_t height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    static std::vector<const char*> instance_extensions();
    VkSurfaceKHR make_surface(VkInstance) const;
    void attach(const Gpu&); ///< before the functions below

    bool open(); ///< handles events; false once it is to be closed
    bool take_next(); ///< whether the space bar was pressed since the last call
    void set_size(uint32_t width, uint32_t height);
    VkExtent2D extent() const { return extent_; } ///< of the swapchain

    /// The semaphore to wait for before the window's image is written; makes the swapchain anew where the window has changed.
    VkSemaphore acquire(uint32_t frame);
    void show(VkCommandBuffer, const Image& picture); ///< which is in TRANSFER_SRC_OPTIMAL
    VkSemaphore shown() const { return shown_[image_]; } ///< to be signalled by what records `show`
    void present();

    void destroyers(std::vector<std::function<void()>>& out);

private:
    void make_swapchain();
    void destroy_swapchain();
    GLFWwindow* window_;
    const Gpu* gpu_ = nullptr;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::vector<VkImage> images_;
    std::vector<VkSemaphore> shown_; ///< one an image: it is free again when the image is
    std::array<VkSemaphore, 2> acquired_{}; ///< one a frame in flight
    uint32_t image_ = 0;
    bool stale_ = false, space_ = false;
};

} // namespace host
