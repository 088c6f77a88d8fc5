// SPDX-License-Identifier: Apache-2.0
#include "renderer.h"

#include <cmath>
#include <cstring>

namespace host {

namespace {

constexpr VkPipelineStageFlags2 depth_stages = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 depth_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkPipelineStageFlags2 color_stage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkAccessFlags2 color_access = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;

VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load)
{
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = layout;
    info.loadOp = load;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

/// A colour attachment that is cleared, and averaged into `resolved` where that is given.
VkRenderingAttachmentInfo drawn(const Image& image, const Image* resolved)
{
    VkRenderingAttachmentInfo info = attachment(image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_LOAD_OP_CLEAR);
    if (!resolved) return info;
    info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    info.resolveImageView = resolved->view;
    info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return info;
}

void begin_rendering(
    VkCommandBuffer commands, VkExtent2D extent, const VkRenderingAttachmentInfo* color, const VkRenderingAttachmentInfo& depth)
{
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = color ? 1 : 0;
    info.pColorAttachments = color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
}

PushConstants push_constants(const Convention& convention, const View& view, const Light& light)
{
    PushConstants push{};
    push.clip_from_host = view.clip_from_view * view.view_from_host;
    const auto store = [](float(&to)[4], Vec3 v, float w) { to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = w; };
    store(push.light_position, light.position, light.lamp ? 1.0f : 0.0f);
    store(push.light_direction, light.direction, 0);
    store(push.up, convention.direction({0, 1, 0}), convention.metres);
    store(push.cone, {std::cos(light.outer_angle), std::cos(light.inner_angle), 0}, 0);
    return push;
}

} // namespace

void transition(VkCommandBuffer commands, const Image& image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to,
    VkPipelineStageFlags2 after, VkAccessFlags2 written, VkPipelineStageFlags2 before, VkAccessFlags2 used)
{
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = after, barrier.srcAccessMask = written;
    barrier.dstStageMask = before, barrier.dstAccessMask = used;
    barrier.oldLayout = from, barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

void Renderer::draw_scene(VkPipeline pipeline, const Slot& slot, const PushConstants& push) const
{
    const VkCommandBuffer commands = slot.commands;
    const VkExtent2D extent = targets_.picture.extent;
    const float width = float(extent.width), height = float(extent.height);
    const VkViewport viewport
        = options_.convention.y_up ? VkViewport{0, height, width, -height, 0, 1} : VkViewport{0, 0, width, height, 0, 1};
    const VkRect2D scissor{{0, 0}, extent};
    const VkDeviceSize start = 0;
    // Gnomon leaves no state of a command buffer as it was: all of it is set again.
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 0, 1, &slot.set, 0, nullptr);
    vkCmdPushConstants(commands, pipelines_.layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(push), &push);
    vkCmdBindVertexBuffers(commands, 0, 1, &scene_.vertices.buffer, &start);
    vkCmdBindIndexBuffer(commands, scene_.indices.buffer, 0, VK_INDEX_TYPE_UINT16);
    for (uint32_t i = 0; i < scene_.instances.size(); ++i) {
        const Mesh& mesh = scene_.meshes[scene_.instances[i]];
        vkCmdDrawIndexed(commands, mesh.index_count, 1, mesh.first_index, int32_t(mesh.first_vertex), i);
    }
}

void Renderer::depth_pass(const Slot& slot, const PushConstants& push) const
{
    VkRenderingAttachmentInfo depth
        = attachment(targets_.depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_LOAD_OP_CLEAR);
    depth.clearValue.depthStencil.depth = options_.convention.reversed_depth ? 0.0f : 1.0f;
    VkRenderingAttachmentInfo normals{};
    if (targets_.normals)
        normals = drawn(targets_.normals_samples ? *targets_.normals_samples : *targets_.normals,
            targets_.normals_samples ? &*targets_.normals : nullptr);
    begin_rendering(slot.commands, targets_.picture.extent, targets_.normals ? &normals : nullptr, depth);
    draw_scene(pipelines_.depth, slot, push);
    vkCmdEndRendering(slot.commands);
}

void Renderer::lit_pass(const Slot& slot, const PushConstants& push) const
{
    const VkRenderingAttachmentInfo depth
        = attachment(targets_.depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_ATTACHMENT_LOAD_OP_LOAD);
    const bool multisampled = targets_.color.image != VK_NULL_HANDLE;
    VkRenderingAttachmentInfo color = drawn(multisampled ? targets_.color : targets_.picture, multisampled ? &targets_.picture : nullptr);
    color.clearValue.color = {{0.55f, 0.65f, 0.75f, 1.0f}};
    begin_rendering(slot.commands, targets_.picture.extent, &color, depth);
    draw_scene(pipelines_.lit, slot, push);
    vkCmdEndRendering(slot.commands);
}

void Renderer::draw(uint32_t frame, size_t technique)
{
    const float seconds = float(frame) / 60;
    const VkExtent2D extent = targets_.picture.extent;
    const std::vector<InstanceData> posed = scene_.pose(seconds);
    std::memcpy(slot_->instances.mapped, posed.data(), posed.size() * sizeof(InstanceData));
    const VkDescriptorBufferInfo instances{slot_->instances.buffer, 0, VK_WHOLE_SIZE};
    const VkDescriptorImageInfo visibility{pipelines_.sampler, targets_.visibility.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    std::array<VkWriteDescriptorSet, 2> writes{};
    for (uint32_t i = 0; i < 2; ++i) {
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstSet = slot_->set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = i ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &instances;
        writes[i].pImageInfo = &visibility;
    }
    vkUpdateDescriptorSets(gpu_.device, uint32_t(writes.size()), writes.data(), 0, nullptr);

    // The targets' old content is not needed, but the last frame's use of them must be over.
    const VkCommandBuffer commands = slot_->commands;
    const auto fresh
        = [&](const Image& image, VkImageAspectFlags aspect, VkImageLayout to, VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
              transition(commands, image, aspect, VK_IMAGE_LAYOUT_UNDEFINED, to, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                  VK_ACCESS_2_MEMORY_WRITE_BIT, stages, access);
          };
    const bool stencil = targets_.depth.format == VK_FORMAT_D24_UNORM_S8_UINT;
    fresh(targets_.depth, VK_IMAGE_ASPECT_DEPTH_BIT | (VkImageAspectFlags(stencil ? VK_IMAGE_ASPECT_STENCIL_BIT : 0)),
        VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, depth_stages, depth_access);
    for (const Image& image : images_of_targets())
        if (image.image != targets_.depth.image && image.image != targets_.visibility.image)
            fresh(image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, color_stage, color_access);

    const Light light = scene_.light(seconds, options_.lamp);
    const View view = scene_.view(seconds, float(extent.width) / float(extent.height));
    const PushConstants push = push_constants(options_.convention, view, light);
    depth_pass(*slot_, push);
    // Between here and the lit pass the host needs no barrier of its own: Gnomon waits for what was recorded before it, and leaves
    // depth and normals as it found them and its output to be read.
    slot_->ticket = shadows_.record(technique,
        {commands, frame, posed, light, view, targets_.depth, targets_.normals ? &*targets_.normals : nullptr, targets_.visibility});
    lit_pass(*slot_, push);
    transition(commands, targets_.picture, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, color_stage, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
        VK_ACCESS_2_TRANSFER_READ_BIT);
}

} // namespace host
