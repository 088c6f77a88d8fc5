// SPDX-License-Identifier: Apache-2.0
#include "gpu/pass_list_impl.h"

#include "gpu/device.h"

#include <stdexcept>

namespace gnomon::gpu {

PassList::PassList(Device& device)
    : impl_(new Impl{ListData{device, {}, {}, {}, {}}})
{
}
PassList::~PassList() = default;
PassList::PassList(PassList&&) noexcept = default;
Device& PassList::device() const { return impl_->device; }
const ImageDesc& PassList::desc(ImageId id) const { return impl_->images.at(id.index).desc; }
void PassList::group(std::string name) { impl_->group = std::move(name); }

ImageId PassList::import(Image& image)
{
    auto& images = impl_->images;
    for (uint32_t i = 0; i < images.size(); ++i)
        if (images[i].imported == &image) return {i};
    if (!image) throw std::logic_error("PassList::import: the image is empty; make it with Device::image");
    images.push_back({&image, image.desc()});
    return {uint32_t(images.size() - 1)};
}

BufferId PassList::import(Buffer& buffer)
{
    auto& buffers = impl_->buffers;
    for (uint32_t i = 0; i < buffers.size(); ++i)
        if (buffers[i].imported == &buffer) return {i};
    if (!buffer) throw std::logic_error("PassList::import: the buffer is empty; make it with Device::buffer");
    buffers.push_back({&buffer, buffer.desc()});
    return {uint32_t(buffers.size() - 1)};
}

ImageId PassList::transient(const ImageDesc& desc)
{
    impl_->images.push_back({nullptr, desc, impl_->group});
    return {uint32_t(impl_->images.size() - 1)};
}

BufferId PassList::transient(const BufferDesc& desc)
{
    impl_->buffers.push_back({nullptr, desc, impl_->group});
    return {uint32_t(impl_->buffers.size() - 1)};
}

void PassList::compute(ComputePass pass)
{
    check_bound({pass.name, pass.program, pass.bindings, pass.constants, pass.textures}, impl_->images, impl_->buffers, false);
    std::string name = impl_->prefix() + pass.name;
    impl_->passes.push_back({std::move(name), std::move(pass)});
}

void PassList::trace(RayPass pass)
{
    check_bound({pass.name, pass.program, pass.bindings, pass.constants, pass.textures}, impl_->images, impl_->buffers, false);
    std::string name = impl_->prefix() + pass.name;
    impl_->passes.push_back({std::move(name), std::move(pass)});
}

void PassList::raster(RasterPass pass)
{
    check_bound({pass.name, pass.program, pass.bindings, pass.constants, pass.textures}, impl_->images, impl_->buffers, true);
    const auto& images = impl_->images;
    const auto attachment = [&](ImageId id, bool depth) {
        if (id.index >= images.size() || is_depth(images[id.index].desc.format) != depth)
            throw std::logic_error(fmt::format(
                "pass '{}': a {} target is no {} image of this list", pass.name, depth ? "depth" : "colour", depth ? "depth" : "colour"));
    };
    bool sized = pass.size != Size{};
    for (const auto& color : pass.colors) {
        if (!color.image) continue;
        attachment(color.image, false);
        if (color.resolve) attachment(color.resolve, false);
        sized = true;
    }
    if (pass.depth) attachment(pass.depth->image, true), sized = true;
    if (!sized) throw std::logic_error(fmt::format("pass '{}' has neither attachments nor a size", pass.name));
    if (!pass.draw) throw std::logic_error(fmt::format("pass '{}' has no draw function", pass.name));
    std::string name = impl_->prefix() + pass.name;
    impl_->passes.push_back({std::move(name), std::move(pass)});
}

void PassList::fullscreen(FullscreenPass pass)
{
    check_bound({pass.name, pass.program, pass.bindings, pass.constants, pass.textures}, impl_->images, impl_->buffers, false);
    RasterPass r;
    r.name = std::move(pass.name);
    r.program = pass.program;
    r.bindings = std::move(pass.bindings);
    r.constants = std::move(pass.constants);
    r.textures = pass.textures;
    r.colors = std::move(pass.colors);
    r.draw = [](Encoder& e) { e.draw(3); };
    raster(std::move(r));
}

void PassList::copy(ImageId from, ImageId to, const char* name)
{
    const ImageDesc &a = desc(from), &b = desc(to);
    if (a.format != b.format || a.size != b.size || a.layers != b.layers || a.mips != b.mips || a.samples != b.samples)
        throw std::logic_error(
            fmt::format("copy '{}': images '{}' and '{}' differ in format, size, layers, mips or samples", name, a.name, b.name));
    impl_->passes.push_back({impl_->prefix() + name, CopyImage{from, to}});
}

void PassList::copy(BufferId from, BufferId to, uint64_t bytes, uint64_t from_offset, uint64_t to_offset, const char* name)
{
    const BufferDesc &a = impl_->buffers.at(from.index).desc, &b = impl_->buffers.at(to.index).desc;
    if (from_offset + bytes > a.bytes || to_offset + bytes > b.bytes)
        throw std::logic_error(
            fmt::format("copy '{}': {} bytes do not fit buffers '{}' and '{}' at these offsets", name, bytes, a.name, b.name));
    impl_->passes.push_back({impl_->prefix() + name, CopyBuffer{from, to, bytes, from_offset, to_offset}});
}

void PassList::fill(BufferId buffer, uint32_t value, const char* name)
{
    impl_->buffers.at(buffer.index);
    impl_->passes.push_back({impl_->prefix() + name, FillBuffer{buffer, value}});
}

void PassList::clear(ImageId image, VkClearColorValue value, const char* name)
{
    impl_->images.at(image.index);
    impl_->passes.push_back({impl_->prefix() + name, ClearImage{image, value}});
}

} // namespace gnomon::gpu
