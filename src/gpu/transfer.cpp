// SPDX-License-Identifier: Apache-2.0
#include "gpu/resources_impl.h"

#include <cstring>
#include <stdexcept>

namespace gnomon::gpu {

namespace {

/// Textures rest in SHADER_READ_ONLY, where texture tables expect them.
Access at_rest()
{
    return {
        VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, false, true};
}

uint64_t check_part(const Image& image, uint32_t layer, uint32_t mip, const char* call)
{
    const ImageDesc& d = image.desc();
    if (layer >= d.layers || mip >= d.mips || d.samples != VK_SAMPLE_COUNT_1_BIT)
        throw std::logic_error(fmt::format("{}: image '{}' has no layer {} and mip {} of one sample", call, d.name, layer, mip));
    return mip_size(d.size, mip).area() * texel_bytes(d.format);
}

VkBufferImageCopy copy_of(const ImageDesc& d, uint32_t layer, uint32_t mip)
{
    const Size size = mip_size(d.size, mip);
    return {0, 0, 0, {main_aspect(d.format), mip, layer, 1}, {0, 0, 0}, {uint32_t(size.width), uint32_t(size.height), 1}};
}

void require_queue(const Context& c)
{
    if (!c.queue) throw std::logic_error("read_back: this device has no queue; copy into a buffer of your own");
}

/// `changed`, one of the two, is in device memory; its state follows only once the commands are through.
void copy_buffer(
    Context& c, const std::string& about, const Buffer& from, const Buffer& to, const VkBufferCopy& region, const Buffer& changed)
{
    const Use use = &changed == &to ? Use::copy_to : Use::copy_from;
    BufferState state = changed.state();
    c.run(about, [&](VkCommandBuffer commands) {
        c.barrier(commands, changed, transition(state, access_of(use, PassKind::transfer, false)));
        c.vk.vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &region);
    });
    changed.state() = state;
}

} // namespace

void Device::upload(Image& image, std::span<const std::byte> texels, uint32_t layer, uint32_t mip)
{
    const uint64_t bytes = check_part(image, layer, mip, "upload");
    if (texels.size() != bytes)
        throw std::logic_error(
            fmt::format("upload: image '{}' takes {} bytes at mip {}, not {}", image.desc().name, bytes, mip, texels.size()));
    Context& c = *impl_;
    const Buffer staging = buffer({bytes, 0, Memory::upload, "staging for " + image.desc().name});
    std::memcpy(staging.mapped(), texels.data(), bytes);
    const VkBufferImageCopy region = copy_of(image.desc(), layer, mip);
    const Range range{layer, 1, mip, 1};
    ImageState state = image.state();
    c.run("an upload to image '" + image.desc().name + "'", [&](VkCommandBuffer commands) {
        c.barrier(commands, image, transition(state, range, access_of(Use::copy_to, PassKind::transfer, false)));
        c.vk.vkCmdCopyBufferToImage(commands, staging.handle(), image.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        Access rest = at_rest();
        if (is_depth(image.desc().format)) rest.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
        c.barrier(commands, image, transition(state, range, rest));
    });
    image.state() = std::move(state);
}

void Device::upload(Buffer& to, std::span<const std::byte> bytes, uint64_t offset)
{
    if (offset + bytes.size() > to.desc().bytes)
        throw std::logic_error(
            fmt::format("upload: buffer '{}' has {} bytes, not {} from {}", to.desc().name, to.desc().bytes, bytes.size(), offset));
    if (bytes.empty()) return;
    if (to.mapped()) {
        std::memcpy(to.mapped() + offset, bytes.data(), bytes.size());
        return;
    }
    Context& c = *impl_;
    // A scene's largest buffer would otherwise be held twice.
    constexpr uint64_t chunk = uint64_t(64) << 20;
    for (uint64_t done = 0; done < bytes.size(); done += chunk) {
        const uint64_t size = std::min<uint64_t>(chunk, bytes.size() - done);
        const Buffer staging = buffer({size, 0, Memory::upload, "staging for " + to.desc().name});
        std::memcpy(staging.mapped(), bytes.data() + done, size);
        copy_buffer(c, "an upload to buffer '" + to.desc().name + "'", staging, to, {0, offset + done, size}, to);
    }
}

void Device::generate_mips(Image& image)
{
    Context& c = *impl_;
    const ImageDesc& d = image.desc();
    constexpr VkFormatFeatureFlags2 needed
        = VK_FORMAT_FEATURE_2_BLIT_SRC_BIT | VK_FORMAT_FEATURE_2_BLIT_DST_BIT | VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (is_depth(d.format) || (c.format_features(d.format) & needed) != needed)
        throw std::logic_error(
            fmt::format("generate_mips: {} has no linear blit (image '{}'); fill the mips by passes", format_info(d.format).name, d.name));
    const Access from = access_of(Use::copy_from, PassKind::transfer, false), to = access_of(Use::copy_to, PassKind::transfer, false);
    ImageState state = image.state();
    c.run("the mips of image '" + d.name + "'", [&](VkCommandBuffer commands) {
        for (uint32_t mip = 1; mip < d.mips; ++mip) {
            c.barrier(commands, image, transition(state, {0, d.layers, mip - 1, 1}, from));
            c.barrier(commands, image, transition(state, {0, d.layers, mip, 1}, to));
            const Size big = mip_size(d.size, mip - 1), small = mip_size(d.size, mip);
            VkImageBlit blit{};
            blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip - 1, 0, d.layers};
            blit.srcOffsets[1] = {big.width, big.height, 1};
            blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, d.layers};
            blit.dstOffsets[1] = {small.width, small.height, 1};
            c.vk.vkCmdBlitImage(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image.handle(),
                VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
        }
        c.barrier(commands, image, transition(state, whole(state), at_rest()));
    });
    image.state() = std::move(state);
}

std::vector<std::byte> Device::read_back_bytes(Image& image, uint32_t layer, uint32_t mip)
{
    const uint64_t bytes = check_part(image, layer, mip, "read_back");
    if (image.state().part(layer, mip).layout == VK_IMAGE_LAYOUT_UNDEFINED)
        throw std::logic_error(fmt::format("read_back: nothing wrote image '{}', layer {}, mip {}", image.desc().name, layer, mip));
    Context& c = *impl_;
    require_queue(c);
    const Buffer staging = buffer({bytes, 0, Memory::read_back, "read-back of " + image.desc().name});
    const VkBufferImageCopy region = copy_of(image.desc(), layer, mip);
    ImageState state = image.state();
    c.run("a read-back of image '" + image.desc().name + "'", [&](VkCommandBuffer commands) {
        const SubresourceState before = state.part(layer, mip);
        const Range range{layer, 1, mip, 1};
        c.barrier(commands, image, transition(state, range, access_of(Use::copy_from, PassKind::transfer, false)));
        c.vk.vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.handle(), 1, &region);
        // Back to where it was: reading a texture must not take it out of a table's layout.
        const Access back{
            VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, before.layout, false, true};
        c.barrier(commands, image, transition(state, range, back));
    });
    image.state() = std::move(state);
    return {staging.mapped(), staging.mapped() + bytes};
}

base::Picture Device::read_back(Image& image, uint32_t layer, uint32_t mip)
{
    return to_picture(image.desc().format, mip_size(image.desc().size, mip), read_back_bytes(image, layer, mip));
}

std::vector<std::byte> Device::read_back(Buffer& from)
{
    const uint64_t bytes = from.desc().bytes;
    if (from.mapped()) return {from.mapped(), from.mapped() + bytes};
    Context& c = *impl_;
    require_queue(c);
    const Buffer staging = buffer({bytes, 0, Memory::read_back, "read-back of " + from.desc().name});
    copy_buffer(c, "a read-back of buffer '" + from.desc().name + "'", from, staging, {0, 0, bytes}, from);
    return {staging.mapped(), staging.mapped() + bytes};
}

} // namespace gnomon::gpu
