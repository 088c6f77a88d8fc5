// SPDX-License-Identifier: Apache-2.0
#include "gpu/resources_impl.h"

#include <stdexcept>

namespace gnomon::gpu {

namespace {

VkImageUsageFlags usage_of(VkFormatFeatureFlags2 features, const ImageDesc& desc, bool storage_samples)
{
    VkImageUsageFlags usage = 0;
    const auto add = [&](VkFormatFeatureFlags2 feature, VkImageUsageFlags bit) { usage |= features & feature ? bit : 0; };
    add(VK_FORMAT_FEATURE_2_TRANSFER_SRC_BIT, VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    add(VK_FORMAT_FEATURE_2_TRANSFER_DST_BIT, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    add(VK_FORMAT_FEATURE_2_SAMPLED_IMAGE_BIT, VK_IMAGE_USAGE_SAMPLED_BIT);
    add(VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    add(VK_FORMAT_FEATURE_2_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    if (desc.samples == VK_SAMPLE_COUNT_1_BIT || storage_samples) add(VK_FORMAT_FEATURE_2_STORAGE_IMAGE_BIT, VK_IMAGE_USAGE_STORAGE_BIT);
    return usage;
}

void refuse(const Context& c, const ImageDesc& d, const VkImageFormatProperties& most)
{
    const auto too_much = [&](const std::string& what) {
        base::fail("image '{}' ({} x {}, {} layers, {} mips, {} samples, {}) is more than device '{}' can make: {}; choose a smaller "
                   "--size or map",
            d.name, d.size.width, d.size.height, d.layers, d.mips, int(d.samples), format_info(d.format).name, c.info.name, what);
    };
    if (d.size.width < 1 || d.size.height < 1 || d.layers < 1 || d.mips < 1)
        throw std::logic_error(fmt::format("image '{}' has a size, layer or mip count below 1", d.name));
    if (uint32_t(d.size.width) > most.maxExtent.width || uint32_t(d.size.height) > most.maxExtent.height)
        too_much(fmt::format("at most {} x {} (maxImageDimension2D)", most.maxExtent.width, most.maxExtent.height));
    if (d.layers > most.maxArrayLayers) too_much(fmt::format("at most {} layers (maxImageArrayLayers)", most.maxArrayLayers));
    if (d.mips > most.maxMipLevels) too_much(fmt::format("at most {} mips", most.maxMipLevels));
    // Mips add a third; a driver's own alignment is its affair.
    const double bytes = double(d.size.area()) * d.layers * int(d.samples) * double(texel_bytes(d.format)) * (d.mips > 1 ? 4.0 / 3.0 : 1.0);
    if (bytes > double(most.maxResourceSize))
        too_much(fmt::format(
            "{:.1f} MiB, at most {:.1f} MiB for an image (maxResourceSize)", bytes / 1048576.0, double(most.maxResourceSize) / 1048576.0));
    if (!(most.sampleCounts & d.samples)) too_much(fmt::format("sample counts are the bits of {}", most.sampleCounts));
}

} // namespace

Image::Impl::~Impl()
{
    if (!handle) return;
    context->release([c = context, image = owned ? handle : VkImage(VK_NULL_HANDLE), held = memory, old = std::move(views)] {
        for (const View& v : old) c->vk.vkDestroyImageView(c->handle, v.view, nullptr);
        c->vk.vkDestroyImage(c->handle, image, nullptr);
        c->memory->free(held);
    });
}

Image::Image() = default;
Image::Image(Image&&) noexcept = default;
Image& Image::operator=(Image&&) noexcept = default;
Image::~Image() = default;
const ImageDesc& Image::desc() const { return impl_->desc; }
VkImage Image::handle() const { return impl_->handle; }
uint64_t Image::bytes() const { return impl_->memory.size; }
Image::operator bool() const { return impl_ != nullptr; }
ImageState& Image::state() const { return impl_->state; }

VkImageView Image::view(
    VkImageViewType type, uint32_t first_layer, uint32_t layers, uint32_t first_mip, uint32_t mips, VkImageAspectFlags aspect) const
{
    const Range range{first_layer, layers, first_mip, mips};
    for (const auto& v : impl_->views)
        if (v.type == type && v.range == range && v.aspect == aspect) return v.view;
    const Context& c = *impl_->context;
    VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = impl_->handle;
    info.viewType = type;
    info.format = impl_->desc.format;
    info.subresourceRange = {aspect, first_mip, mips, first_layer, layers};
    VkImageView view;
    check(c.vk.vkCreateImageView(c.handle, &info, nullptr, &view), "vkCreateImageView", impl_->desc.name);
    c.name(VK_OBJECT_TYPE_IMAGE_VIEW, uint64_t(view), impl_->desc.name);
    impl_->views.push_back({type, range, aspect, view});
    return view;
}

Image Device::image(const ImageDesc& desc)
{
    Context& c = *impl_;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.flags = desc.cube ? VkImageCreateFlags(VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT) : 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = desc.format;
    info.extent = {uint32_t(desc.size.width), uint32_t(desc.size.height), 1};
    info.mipLevels = desc.mips;
    info.arrayLayers = desc.layers;
    info.samples = desc.samples;
    info.usage = usage_of(c.format_features(desc.format), desc, false);
    if (!info.usage)
        base::fail("image '{}': device '{}' does not know the format {}; choose another device", desc.name, c.info.name,
            format_info(desc.format).name);
    const VkPhysicalDeviceImageFormatInfo2 asked{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGE_FORMAT_INFO_2, nullptr, info.format,
        info.imageType, VK_IMAGE_TILING_OPTIMAL, info.usage, info.flags};
    VkImageFormatProperties2 most{VK_STRUCTURE_TYPE_IMAGE_FORMAT_PROPERTIES_2};
    check(
        c.vk.vkGetPhysicalDeviceImageFormatProperties2(c.physical, &asked, &most), "vkGetPhysicalDeviceImageFormatProperties2", desc.name);
    refuse(c, desc, most.imageFormatProperties);

    Image image;
    image.impl_ = std::make_unique<Image::Impl>();
    Image::Impl& i = *image.impl_;
    i.context = &c;
    i.desc = desc;
    i.state.layers = desc.layers;
    i.state.mips = desc.mips;
    const std::string about = fmt::format("image '{}' ({} x {})", desc.name, desc.size.width, desc.size.height);
    check(c.vk.vkCreateImage(c.handle, &info, nullptr, &i.handle), "vkCreateImage", about);
    MemoryRequest request{{}, Memory::device, false, i.handle, VK_NULL_HANDLE, about};
    c.vk.vkGetImageMemoryRequirements(c.handle, i.handle, &request.needs);
    i.memory = c.memory->allocate(request);
    check(c.vk.vkBindImageMemory(c.handle, i.handle, i.memory.memory, i.memory.offset), "vkBindImageMemory", about);
    c.name(VK_OBJECT_TYPE_IMAGE, uint64_t(i.handle), desc.name);
    return image;
}

Image Device::adopt_image(VkImage handle, const ImageDesc& desc, VkImageLayout layout)
{
    Image image;
    image.impl_ = std::make_unique<Image::Impl>();
    Image::Impl& i = *image.impl_;
    i.context = impl_.get();
    i.desc = desc;
    i.handle = handle;
    i.owned = false;
    i.state.layers = desc.layers;
    i.state.mips = desc.mips;
    // What the caller did to it before is not known here: the first barrier waits for everything.
    i.state.parts[0].layout = layout;
    i.state.parts[0].write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    i.state.parts[0].write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    return image;
}

} // namespace gnomon::gpu
