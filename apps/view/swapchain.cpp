// SPDX-License-Identifier: Apache-2.0
#include "swapchain.h"

#include "base/error.h"

#include <algorithm>

namespace gnomon::view {

using gpu::check;

Swapchain::Swapchain(gpu::Device& device, VkSurfaceKHR surface)
    : device_(device)
    , surface_(surface)
{
    const PFN_vkGetInstanceProcAddr get = gpu::system_loader();
    const auto load
        = [&](auto& f, const char* name) { f = reinterpret_cast<std::remove_reference_t<decltype(f)>>(get(device.instance(), name)); };
    load(surface_vk_.destroy, "vkDestroySurfaceKHR");
    load(surface_vk_.support, "vkGetPhysicalDeviceSurfaceSupportKHR");
    load(surface_vk_.capabilities, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    load(surface_vk_.formats, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    gpu::load_device(vk_, gpu::load_instance(get, device.instance()), device.handle());
    VkBool32 supported = VK_FALSE;
    surface_vk_.support(device.physical(), device.queue_family(), surface, &supported);
    if (!supported || !device.supports(VK_KHR_SWAPCHAIN_EXTENSION_NAME)) {
        surface_vk_.destroy(device.instance(), surface, nullptr);
        base::fail("device '{}' cannot show pictures in this window; choose another with --device", device.info().name);
    }
    choose_format();
    const VkDevice handle = device.handle();
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vk_.vkCreateFence(handle, &fence, nullptr, &fence_), "vkCreateFence");
    acquired_ = semaphore();
    const VkCommandPoolCreateInfo pool{
        VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, device.queue_family()};
    check(vk_.vkCreateCommandPool(handle, &pool, nullptr, &pool_), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo buffer{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vk_.vkAllocateCommandBuffers(handle, &buffer, &commands_), "vkAllocateCommandBuffers");
}

Swapchain::~Swapchain()
{
    vk_.vkDeviceWaitIdle(device_.handle());
    if (ticket_) device_.retire(ticket_);
    drop();
    vk_.vkDestroySemaphore(device_.handle(), acquired_, nullptr);
    vk_.vkDestroyFence(device_.handle(), fence_, nullptr);
    vk_.vkDestroyCommandPool(device_.handle(), pool_, nullptr);
    surface_vk_.destroy(device_.instance(), surface_, nullptr);
}

/// Colours come encoded for the screen, so that an sRGB format would encode them twice.
void Swapchain::choose_format()
{
    uint32_t count = 0;
    check(surface_vk_.formats(device_.physical(), surface_, &count, nullptr), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(surface_vk_.formats(device_.physical(), surface_, &count, formats.data()), "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (const VkSurfaceFormatKHR& f : formats)
        if (f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM) {
            format_ = f;
            return;
        }
    base::fail("device '{}' offers no 8-bit format for windows; choose another with --device", device_.info().name);
}

VkSemaphore Swapchain::semaphore()
{
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore made;
    check(vk_.vkCreateSemaphore(device_.handle(), &info, nullptr, &made), "vkCreateSemaphore");
    return made;
}

void Swapchain::drop()
{
    images_.clear();
    for (const VkSemaphore s : drawn_) vk_.vkDestroySemaphore(device_.handle(), s, nullptr);
    drawn_.clear();
    vk_.vkDestroySwapchainKHR(device_.handle(), handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
}

void Swapchain::wait_and_drop()
{
    wait();
    vk_.vkDeviceWaitIdle(device_.handle());
    drop();
}

bool Swapchain::make(base::Size window)
{
    vk_.vkDeviceWaitIdle(device_.handle());
    VkSurfaceCapabilitiesKHR most{};
    check(surface_vk_.capabilities(device_.physical(), surface_, &most), "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    VkExtent2D extent = most.currentExtent;
    if (extent.width == ~0u)
        extent = {std::clamp(uint32_t(window.width), most.minImageExtent.width, most.maxImageExtent.width),
            std::clamp(uint32_t(window.height), most.minImageExtent.height, most.maxImageExtent.height)};
    if (extent.width == 0 || extent.height == 0) return false;
    const uint32_t wanted = most.minImageCount + 1;
    VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
    info.surface = surface_;
    info.minImageCount = most.maxImageCount ? std::min(wanted, most.maxImageCount) : wanted;
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    info.preTransform = most.currentTransform;
    info.compositeAlpha = most.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                           : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    info.clipped = VK_TRUE;
    drop();
    check(vk_.vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &handle_), "vkCreateSwapchainKHR");
    uint32_t count = 0;
    check(vk_.vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, nullptr), "vkGetSwapchainImagesKHR");
    std::vector<VkImage> images(count);
    check(vk_.vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, images.data()), "vkGetSwapchainImagesKHR");
    size_ = {int(extent.width), int(extent.height)};
    for (const VkImage image : images) {
        images_.push_back(
            device_.adopt_image(image, {format_.format, size_, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "window"}, VK_IMAGE_LAYOUT_UNDEFINED));
        drawn_.push_back(semaphore());
    }
    return true;
}

void Swapchain::wait()
{
    if (!ticket_) return;
    check(vk_.vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, ~uint64_t(0)), "vkWaitForFences", "the window's picture");
    check(vk_.vkResetFences(device_.handle(), 1, &fence_), "vkResetFences");
    device_.retire(ticket_);
    ticket_ = 0;
}

bool Swapchain::present(base::Size window, const Draw& draw)
{
    wait();
    if (window.area() == 0) return false;
    if ((!handle_ || size_ != window) && !make(window)) return false;
    uint32_t index = 0;
    const VkResult acquired = vk_.vkAcquireNextImageKHR(device_.handle(), handle_, ~uint64_t(0), acquired_, VK_NULL_HANDLE, &index);
    if (acquired == VK_ERROR_OUT_OF_DATE_KHR) {
        wait_and_drop();
        return false;
    }
    check(acquired, "vkAcquireNextImageKHR");
    record(index, draw);
    return submit(index);
}

void Swapchain::record(uint32_t index, const Draw& draw)
{
    check(vk_.vkResetCommandPool(device_.handle(), pool_, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin{
        VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
    check(vk_.vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    gpu::Image& image = images_[index];
    // Whatever the last frame left there is drawn over.
    image.state().parts[0] = {{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0, VK_ACCESS_2_MEMORY_WRITE_BIT, 0}, VK_IMAGE_LAYOUT_UNDEFINED};
    gpu::PassList passes(device_);
    draw(passes, passes.import(image));
    ticket_ = device_.record(std::move(passes), commands_);
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.oldLayout = image.state().parts[0].layout;
    barrier.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vk_.vkCmdPipelineBarrier2(commands_, &dependency);
    check(vk_.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
}

bool Swapchain::submit(uint32_t index)
{
    const VkSemaphoreSubmitInfo wait{
        VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, acquired_, 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    const VkSemaphoreSubmitInfo signal{
        VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO, nullptr, drawn_[index], 0, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
    const VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO, nullptr, commands_, 0};
    VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.waitSemaphoreInfoCount = submit.signalSemaphoreInfoCount = submit.commandBufferInfoCount = 1;
    submit.pWaitSemaphoreInfos = &wait;
    submit.pSignalSemaphoreInfos = &signal;
    submit.pCommandBufferInfos = &commands;
    check(vk_.vkQueueSubmit2(device_.queue(), 1, &submit, fence_), "vkQueueSubmit2", "the window's picture");
    VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    present.waitSemaphoreCount = present.swapchainCount = 1;
    present.pWaitSemaphores = &drawn_[index];
    present.pSwapchains = &handle_;
    present.pImageIndices = &index;
    const VkResult shown = vk_.vkQueuePresentKHR(device_.queue(), &present);
    if (shown == VK_ERROR_OUT_OF_DATE_KHR) {
        wait_and_drop();
        return false;
    }
    check(shown, "vkQueuePresentKHR");
    return true;
}

} // namespace gnomon::view
