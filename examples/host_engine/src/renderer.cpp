// SPDX-License-Identifier: Apache-2.0
#include "renderer.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace host {

Renderer::Renderer(const Gpu& gpu, const Scene& scene, Shadows& shadows, const Options& options)
    : gpu_(gpu)
    , scene_(scene)
    , shadows_(shadows)
    , options_(options)
    , pipelines_(gpu, scene, options.convention)
{
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2}}};
    VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool.maxSets = uint32_t(slots_.size());
    pool.poolSizeCount = uint32_t(sizes.size());
    pool.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(gpu.device, &pool, nullptr, &descriptors_), "vkCreateDescriptorPool");
    for (Slot& slot : slots_) {
        VkCommandPoolCreateInfo commands{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        commands.queueFamilyIndex = gpu.queue_family;
        check(vkCreateCommandPool(gpu.device, &commands, nullptr, &slot.pool), "vkCreateCommandPool");
        VkCommandBufferAllocateInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        buffer.commandPool = slot.pool;
        buffer.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(gpu.device, &buffer, &slot.commands), "vkAllocateCommandBuffers");
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        check(vkCreateFence(gpu.device, &fence, nullptr, &slot.fence), "vkCreateFence");
        VkDescriptorSetAllocateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        set.descriptorPool = descriptors_;
        set.descriptorSetCount = 1;
        set.pSetLayouts = &pipelines_.set_layout;
        check(vkAllocateDescriptorSets(gpu.device, &set, &slot.set), "vkAllocateDescriptorSets");
        slot.instances = gpu.buffer(scene.instances.size() * sizeof(InstanceData), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    }
    make_targets({options.width, options.height});
}

void Renderer::make_targets(VkExtent2D extent)
{
    const Convention& c = options_.convention;
    const auto one = VK_SAMPLE_COUNT_1_BIT;
    constexpr VkImageUsageFlags drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, read = VK_IMAGE_USAGE_SAMPLED_BIT;
    targets_ = {};
    targets_.depth = gpu_.image(c.depth_format, extent, c.samples, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | read);
    if (const VkFormat normals = normals_format(c.normals)) {
        targets_.normals = gpu_.image(normals, extent, one, drawn | read);
        if (c.samples != one) targets_.normals_samples = gpu_.image(normals, extent, c.samples, drawn);
    }
    targets_.visibility = gpu_.image(VK_FORMAT_R8_UNORM, extent, one, drawn | read);
    if (c.samples != one) targets_.color = gpu_.image(color_format, extent, c.samples, drawn);
    targets_.picture = gpu_.image(color_format, extent, one, drawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
}

std::vector<Image> Renderer::images_of_targets() const
{
    std::vector<Image> out{targets_.depth, targets_.visibility, targets_.picture};
    if (targets_.normals) out.push_back(*targets_.normals);
    if (targets_.normals_samples) out.push_back(*targets_.normals_samples);
    if (targets_.color.image) out.push_back(targets_.color);
    return out;
}

void Renderer::resize(VkExtent2D extent)
{
    if (extent.width == targets_.picture.extent.width && extent.height == targets_.picture.extent.height) return;
    for (const Image& image : images_of_targets()) retired_.push_back({frame_, image});
    make_targets(extent);
}

void Renderer::wait(Slot& slot)
{
    if (!slot.submitted) return;
    check(vkWaitForFences(gpu_.device, 1, &slot.fence, VK_TRUE, ~0ull), "vkWaitForFences");
    check(vkResetFences(gpu_.device, 1, &slot.fence), "vkResetFences");
    slot.submitted = false;
    if (slot.ticket) shadows_.finished(slot.ticket);
    slot.ticket = 0;
}

VkCommandBuffer Renderer::begin(uint32_t frame)
{
    frame_ = frame;
    slot_ = &slots_[frame % slots_.size()];
    wait(*slot_);
    std::erase_if(retired_, [&](const Retired& r) {
        const bool finished = r.frame + slots_.size() <= frame;
        if (finished) gpu_.destroy(r.image);
        return finished;
    });
    check(vkResetCommandPool(gpu_.device, slot_->pool, 0), "vkResetCommandPool");
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(slot_->commands, &info), "vkBeginCommandBuffer");
    return slot_->commands;
}

void Renderer::submit(VkSemaphore wait, VkSemaphore signal)
{
    check(vkEndCommandBuffer(slot_->commands), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    commands.commandBuffer = slot_->commands;
    VkSemaphoreSubmitInfo before{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}, after = before;
    before.semaphore = wait;
    before.stageMask = VK_PIPELINE_STAGE_2_TRANSFER_BIT;
    after.semaphore = signal;
    after.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.waitSemaphoreInfoCount = wait ? 1 : 0;
    info.pWaitSemaphoreInfos = &before;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    info.signalSemaphoreInfoCount = signal ? 1 : 0;
    info.pSignalSemaphoreInfos = &after;
    check(vkQueueSubmit2(gpu_.queue, 1, &info, slot_->fence), "vkQueueSubmit2");
    slot_->submitted = true;
}

void Renderer::finish()
{
    for (Slot& slot : slots_) wait(slot);
}

void Renderer::save(const std::string& path)
{
    const auto [width, height] = targets_.picture.extent;
    const Buffer pixels = gpu_.buffer(VkDeviceSize(4) * width * height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const VkCommandBuffer commands = begin(frame_ + 1);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, targets_.picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels.buffer, 1, &region);
    VkMemoryBarrier2 to_host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
        VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &to_host;
    vkCmdPipelineBarrier2(commands, &dependency);
    submit(VK_NULL_HANDLE, VK_NULL_HANDLE);
    finish();

    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << width << ' ' << height << "\n255\n";
    const char* bytes = static_cast<const char*>(pixels.mapped);
    for (size_t i = 0; i < size_t(width) * height; ++i) file.write(bytes + 4 * i, 3);
    gpu_.destroy(pixels);
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void Renderer::destroyers(std::vector<std::function<void()>>& out)
{
    const Gpu& gpu = gpu_;
    for (const Image& image : images_of_targets()) out.push_back([&gpu, image] { gpu.destroy(image); });
    for (const Retired& r : retired_) out.push_back([&gpu, image = r.image] { gpu.destroy(image); });
    for (const Slot& slot : slots_) {
        out.push_back([&gpu, pool = slot.pool] { vkDestroyCommandPool(gpu.device, pool, nullptr); });
        out.push_back([&gpu, fence = slot.fence] { vkDestroyFence(gpu.device, fence, nullptr); });
        out.push_back([&gpu, buffer = slot.instances] { gpu.destroy(buffer); });
    }
    out.push_back([&gpu, pool = descriptors_] { vkDestroyDescriptorPool(gpu.device, pool, nullptr); });
    pipelines_.destroyers(gpu, out);
}

} // namespace host
