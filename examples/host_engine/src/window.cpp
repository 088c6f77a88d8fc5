// SPDX-License-Identifier: Apache-2.0
#include "window.h"

#include "renderer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <stdexcept>

namespace host {

Window::Window(uint32_t width, uint32_t height)
{
    if (!glfwInit()) throw std::runtime_error("there is no display to open a window on: use --headless");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(int(width), int(height), "host_engine: space for the next technique", nullptr, nullptr);
    if (!window_) throw std::runtime_error("GLFW opens no window: use --headless");
}

Window::~Window()
{
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::vector<const char*> Window::instance_extensions()
{
    uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) throw std::runtime_error("this display shows no Vulkan: use --headless");
    return {names, names + count};
}

VkSurfaceKHR Window::make_surface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    check(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "glfwCreateWindowSurface");
    return surface;
}

void Window::attach(const Gpu& gpu)
{
    gpu_ = &gpu;
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    for (VkSemaphore& s : acquired_) check(vkCreateSemaphore(gpu.device, &info, nullptr, &s), "vkCreateSemaphore");
    make_swapchain();
}

void Window::make_swapchain()
{
    VkSurfaceCapabilitiesKHR surface;
    const auto ask
        = [&] { check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu_->physical, gpu_->surface, &surface), "asking the surface"); };
    for (ask(); surface.currentExtent.width == 0; ask()) glfwWaitEventsTimeout(0.1); // minimised
    extent_ = surface.currentExtent;
    if (extent_.width == ~0u) { // the surface takes the swapchain's size
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        extent_ = {std::clamp(uint32_t(width), surface.minImageExtent.width, surface.maxImageExtent.width),
            std::clamp(uint32_t(height), surface.minImageExtent.height, surface.maxImageExtent.height)};
    }
    uint32_t count = 0;
    vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_->physical, gpu_->surface, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    vkGetPhysicalDeviceSurfaceFormatsKHR(gpu_->physical, gpu_->surface, &count, formats.data());
    const auto plain = std::find_if(formats.begin(), formats.end(),
        [](const VkSurfaceFormatKHR& f) { return f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM; });
    const VkSurfaceFormatKHR format = plain != formats.end() ? *plain : formats.at(0);

    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = gpu_->surface;
    info.minImageCount = std::max(3u, surface.minImageCount);
    if (surface.maxImageCount) info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
    info.imageFormat = format.format;
    info.imageColorSpace = format.colorSpace;
    info.imageExtent = extent_;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = surface.currentTransform;
    info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    check(vkCreateSwapchainKHR(gpu_->device, &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");
    check(vkGetSwapchainImagesKHR(gpu_->device, swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
    images_.resize(count);
    check(vkGetSwapchainImagesKHR(gpu_->device, swapchain_, &count, images_.data()), "vkGetSwapchainImagesKHR");
    shown_.resize(count);
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    for (VkSemaphore& s : shown_) check(vkCreateSemaphore(gpu_->device, &semaphore, nullptr, &s), "vkCreateSemaphore");
    stale_ = false;
}

void Window::destroy_swapchain()
{
    for (VkSemaphore s : shown_) vkDestroySemaphore(gpu_->device, s, nullptr);
    shown_.clear();
    vkDestroySwapchainKHR(gpu_->device, swapchain_, nullptr);
    swapchain_ = VK_NULL_HANDLE;
}

bool Window::open()
{
    glfwPollEvents();
    static_assert(GLFW_PRESS == 1);
    if (glfwGetKey(window_, GLFW_KEY_ESCAPE) == GLFW_PRESS) glfwSetWindowShouldClose(window_, GLFW_TRUE);
    return !glfwWindowShouldClose(window_);
}

bool Window::take_next()
{
    const bool before = space_;
    space_ = glfwGetKey(window_, GLFW_KEY_SPACE) == GLFW_PRESS;
    return space_ && !before;
}

void Window::set_size(uint32_t width, uint32_t height) { glfwSetWindowSize(window_, int(width), int(height)); }

VkSemaphore Window::acquire(uint32_t frame)
{
    const VkSemaphore semaphore = acquired_[frame % acquired_.size()];
    for (;;) {
        if (stale_) { // presentation has no fence: only the idle device has surely let go of the images
            check(vkDeviceWaitIdle(gpu_->device), "vkDeviceWaitIdle");
            destroy_swapchain();
            make_swapchain();
        }
        const VkResult result = vkAcquireNextImageKHR(gpu_->device, swapchain_, ~0ull, semaphore, VK_NULL_HANDLE, &image_);
        if (result != VK_ERROR_OUT_OF_DATE_KHR) {
            check(result, "vkAcquireNextImageKHR");
            return semaphore;
        }
        stale_ = true;
    }
}

void Window::show(VkCommandBuffer commands, const Image& picture)
{
    const Image target{images_[image_], VK_NULL_HANDLE, VK_NULL_HANDLE, picture.format, extent_};
    transition(commands, target, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        VK_PIPELINE_STAGE_2_TRANSFER_BIT, 0, VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    VkImageBlit region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.srcOffsets[1] = {int32_t(picture.extent.width), int32_t(picture.extent.height), 1};
    region.dstOffsets[1] = {int32_t(extent_.width), int32_t(extent_.height), 1};
    vkCmdBlitImage(commands, picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
        &region, VK_FILTER_NEAREST);
    transition(commands, target, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_NONE, 0);
}

void Window::present()
{
    VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &shown_[image_];
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &image_;
    const VkResult result = vkQueuePresentKHR(gpu_->queue, &info);
    stale_ = result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR;
    if (!stale_) check(result, "vkQueuePresentKHR");
}

void Window::destroyers(std::vector<std::function<void()>>& out)
{
    out.push_back([this] { destroy_swapchain(); });
    for (VkSemaphore s : acquired_) out.push_back([this, s] { vkDestroySemaphore(gpu_->device, s, nullptr); });
}

} // namespace host
