// SPDX-License-Identifier: Apache-2.0
#include "gpu/recorder.h"

#include <bit>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

Range whole(const ImageDesc& desc) { return {0, desc.layers, 0, desc.mips}; }

VkAttachmentLoadOp to_vulkan(Load load)
{
    return load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR
        : load == Load::keep   ? VK_ATTACHMENT_LOAD_OP_LOAD
                               : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}

bool stencil_written(const DepthTarget& d)
{
    const auto writes = [](const VkStencilOpState& s) {
        return s.failOp != VK_STENCIL_OP_KEEP || s.passOp != VK_STENCIL_OP_KEEP || s.depthFailOp != VK_STENCIL_OP_KEEP;
    };
    return d.stencil && (writes(d.front) || writes(d.back));
}

/// Tested only: the image may be sampled by the same pass.
bool read_only(const DepthTarget& d) { return d.load == Load::keep && !d.write && !stencil_written(d); }

} // namespace

uint32_t render_layers(const RasterPass& pass) { return pass.view_mask ? uint32_t(std::bit_width(pass.view_mask)) : pass.layers; }

Size render_size(const RasterPass& pass, const ListData& list)
{
    if (pass.size != Size{}) return pass.size;
    for (const auto& color : pass.colors)
        if (color.image) return mip_size(list.images[color.image.index].desc.size, color.mip);
    return list.images[pass.depth->image.index].desc.size;
}

void Recorder::run(const Pass& pass, const ComputePass& work)
{
    const auto& program = static_cast<const ProgramImpl&>(*work.program);
    begin_pass(PassKind::compute, program, work.bindings, work.constants, work.textures);
    if (work.indirect) use(work.indirect, Use::indirect, PassKind::compute);
    end_uses(pass.name);
    c_.vk.vkCmdBindPipeline(commands_, program.point, program.compute_pipeline());
    bind(program, pass.name);
    if (work.indirect) {
        c_.vk.vkCmdDispatchIndirect(commands_, buffer(work.indirect).handle(), work.indirect_offset);
        return;
    }
    const uint32_t threads[] = {work.threads.x, work.threads.y, work.threads.z};
    uint32_t groups[3];
    for (int i = 0; i < 3; ++i) {
        groups[i] = uint32_t((uint64_t(threads[i]) + program.local_size[size_t(i)] - 1) / program.local_size[size_t(i)]);
        const uint32_t most = c_.properties.limits.maxComputeWorkGroupCount[i];
        if (groups[i] > most)
            base::fail("pass '{}' needs {} groups along {} and device '{}' can run {}; choose a smaller --size", pass.name, groups[i],
                "xyz"[i], c_.info.name, most);
    }
    if (groups[0] && groups[1] && groups[2]) c_.vk.vkCmdDispatch(commands_, groups[0], groups[1], groups[2]);
}

void Recorder::run(const Pass& pass, const RayPass& work)
{
    const auto& program = static_cast<const ProgramImpl&>(*work.program);
    begin_pass(PassKind::trace, program, work.bindings, work.constants, work.textures);
    end_uses(pass.name);
    c_.vk.vkCmdBindPipeline(commands_, program.point, program.ray_pipeline());
    bind(program, pass.name);
    const VkStridedDeviceAddressRegionKHR callable{};
    c_.vk.vkCmdTraceRaysKHR(commands_, &program.raygen_region, &program.miss_region, &program.hit_region, &callable, work.threads.x,
        work.threads.y, work.threads.z);
}

void Recorder::use_attachments(const RasterPass& pass)
{
    const uint32_t layers = render_layers(pass);
    const auto attach = [&](ImageId id, uint32_t layer, uint32_t mip, Use how, bool keep) {
        const ImageDesc& d = list_.images[id.index].desc;
        if (layer + layers > d.layers || mip >= d.mips)
            throw std::logic_error(
                fmt::format("pass '{}': target '{}' has {} layers and {} mips, fewer than asked for", pass.name, d.name, d.layers, d.mips));
        use(id, {layer, layers, mip, 1}, how, PassKind::raster, keep);
    };
    for (const auto& color : pass.colors) {
        if (!color.image) continue;
        attach(color.image, color.layer, color.mip, Use::color, color.load == Load::keep);
        if (color.resolve) attach(color.resolve, color.layer, color.mip, Use::color, false);
    }
    if (pass.depth)
        attach(
            pass.depth->image, pass.depth->layer, 0, read_only(*pass.depth) ? Use::depth_test : Use::depth, pass.depth->load == Load::keep);
}

void Recorder::begin_rendering(const RasterPass& pass, Size size)
{
    const uint32_t layers = render_layers(pass);
    const auto view = [&](ImageId id, uint32_t layer, uint32_t mip) {
        const Image& target = image(id);
        return target.view(
            layers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D, layer, layers, mip, 1, aspects_of(target.desc().format));
    };
    std::vector<VkRenderingAttachmentInfo> colors;
    for (const auto& color : pass.colors) {
        VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        if (color.image) {
            info.imageView = view(color.image, color.layer, color.mip);
            info.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            info.loadOp = to_vulkan(color.load);
            info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            info.clearValue.color = color.clear;
        }
        if (color.image && color.resolve) {
            // Integers have no average.
            info.resolveMode = is_integer(image(color.image).desc().format) ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT : VK_RESOLVE_MODE_AVERAGE_BIT;
            info.resolveImageView = view(color.resolve, color.layer, color.mip);
            info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        }
        colors.push_back(info);
    }
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    if (pass.depth) {
        const DepthTarget& d = *pass.depth;
        depth.imageView = view(d.image, d.layer, 0);
        depth.imageLayout
            = read_only(d) ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        depth.loadOp = to_vulkan(d.load);
        // STORE counts as a write, which a pass that also samples the image must not do.
        depth.storeOp = read_only(d) ? VK_ATTACHMENT_STORE_OP_NONE
            : d.store                ? VK_ATTACHMENT_STORE_OP_STORE
                                     : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        depth.clearValue.depthStencil = {d.clear, d.clear_stencil};
    }
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {uint32_t(size.width), uint32_t(size.height)};
    info.layerCount = pass.view_mask ? 1 : pass.layers;
    info.viewMask = pass.view_mask;
    info.colorAttachmentCount = uint32_t(colors.size());
    info.pColorAttachments = colors.data();
    info.pDepthAttachment = pass.depth ? &depth : nullptr;
    const bool stencil = pass.depth && has_stencil(image(pass.depth->image).desc().format);
    info.pStencilAttachment = stencil ? &depth : nullptr;
    c_.vk.vkCmdBeginRendering(commands_, &info);
}

void Recorder::run(const Pass& pass, const RasterPass& work)
{
    begin_pass(PassKind::raster, static_cast<const ProgramImpl&>(*work.program), work.bindings, work.constants, work.textures);
    for (const auto& [id, how] : work.buffers) use(id, how, PassKind::raster);
    use_attachments(work);
    end_uses(pass.name);
    const Size size = render_size(work, list_);
    begin_rendering(work, size);
    draw(*this, work, pass.name, size);
    c_.vk.vkCmdEndRendering(commands_);
}

void Recorder::run(const Pass& pass, const CopyImage& work)
{
    begin_transfer();
    const Image &from = image(work.from), &to = image(work.to);
    const ImageDesc& d = from.desc();
    use(work.from, whole(d), Use::copy_from, PassKind::transfer, false);
    use(work.to, whole(d), Use::copy_to, PassKind::transfer, false);
    end_uses(pass.name);
    std::vector<VkImageCopy> regions;
    for (uint32_t mip = 0; mip < d.mips; ++mip) {
        const Size size = mip_size(d.size, mip);
        const VkImageSubresourceLayers part{aspects_of(d.format), mip, 0, d.layers};
        regions.push_back({part, {0, 0, 0}, part, {0, 0, 0}, {uint32_t(size.width), uint32_t(size.height), 1}});
    }
    c_.vk.vkCmdCopyImage(commands_, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        uint32_t(regions.size()), regions.data());
}

void Recorder::run(const Pass& pass, const CopyBuffer& work)
{
    begin_transfer();
    use(work.from, Use::copy_from, PassKind::transfer);
    use(work.to, Use::copy_to, PassKind::transfer);
    end_uses(pass.name);
    const VkBufferCopy region{work.from_offset, work.to_offset, work.bytes};
    c_.vk.vkCmdCopyBuffer(commands_, buffer(work.from).handle(), buffer(work.to).handle(), 1, &region);
}

void Recorder::run(const Pass& pass, const FillBuffer& work)
{
    begin_transfer();
    use(work.buffer, Use::copy_to, PassKind::transfer);
    end_uses(pass.name);
    c_.vk.vkCmdFillBuffer(commands_, buffer(work.buffer).handle(), 0, VK_WHOLE_SIZE, work.value);
}

void Recorder::run(const Pass& pass, const ClearImage& work)
{
    begin_transfer();
    const Image& target = image(work.image);
    const ImageDesc& d = target.desc();
    use(work.image, whole(d), Use::copy_to, PassKind::transfer, false);
    end_uses(pass.name);
    const VkImageSubresourceRange range{aspects_of(d.format), 0, d.mips, 0, d.layers};
    if (is_depth(d.format)) {
        const VkClearDepthStencilValue value{work.value.float32[0], 0};
        c_.vk.vkCmdClearDepthStencilImage(commands_, target.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1, &range);
    } else {
        c_.vk.vkCmdClearColorImage(commands_, target.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &work.value, 1, &range);
    }
}

} // namespace gnomon::gpu
