// SPDX-License-Identifier: Apache-2.0
#include "gpu/resources_impl.h"

#include <stdexcept>

namespace gnomon::gpu {

Buffer::Impl::~Impl()
{
    if (!handle || !owned) return;
    context->release([c = context, buffer = handle, held = memory] {
        c->vk.vkDestroyBuffer(c->handle, buffer, nullptr);
        c->memory->free(held);
    });
}

Buffer::Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;
Buffer::~Buffer() = default;
const BufferDesc& Buffer::desc() const { return impl_->desc; }
VkBuffer Buffer::handle() const { return impl_->handle; }
uint64_t Buffer::offset() const { return impl_->offset; }
uint64_t Buffer::range() const { return impl_->owned ? VK_WHOLE_SIZE : impl_->desc.bytes; }
VkDeviceAddress Buffer::address() const { return impl_->address; }
std::byte* Buffer::mapped() const { return impl_->desc.memory == Memory::device ? nullptr : impl_->memory.mapped; }
Buffer::operator bool() const { return impl_ != nullptr; }
BufferState& Buffer::state() const { return impl_->state; }

Buffer Device::buffer(const BufferDesc& desc)
{
    Context& c = *impl_;
    if (desc.bytes == 0) throw std::logic_error(fmt::format("buffer '{}' has no bytes; ask for one element at least", desc.name));
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = desc.bytes;
    info.usage = desc.usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT
        | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    if (c.info.ray_query || c.info.ray_tracing_pipeline) info.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;

    if (desc.bytes > c.largest_buffer)
        base::fail(
            "buffer '{}' needs {:.1f} MiB, more than the {:.1f} MiB that device '{}' takes (maxBufferSize); choose a smaller --size, "
            "map or scene",
            desc.name, double(desc.bytes) / 1048576.0, double(c.largest_buffer) / 1048576.0, c.info.name);
    Buffer buffer;
    buffer.impl_ = std::make_unique<Buffer::Impl>();
    Buffer::Impl& b = *buffer.impl_;
    b.context = &c;
    b.desc = desc;
    const std::string about = fmt::format("buffer '{}'", desc.name);
    check(c.vk.vkCreateBuffer(c.handle, &info, nullptr, &b.handle), "vkCreateBuffer", about);
    MemoryRequest request{{}, desc.memory, true, VK_NULL_HANDLE, b.handle, about};
    c.vk.vkGetBufferMemoryRequirements(c.handle, b.handle, &request.needs);
    b.memory = c.memory->allocate(request);
    check(c.vk.vkBindBufferMemory(c.handle, b.handle, b.memory.memory, b.memory.offset), "vkBindBufferMemory", about);
    const VkBufferDeviceAddressInfo address{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, b.handle};
    b.address = c.vk.vkGetBufferDeviceAddress(c.handle, &address);
    c.name(VK_OBJECT_TYPE_BUFFER, uint64_t(b.handle), desc.name);
    return buffer;
}

Buffer Device::adopt_buffer(VkBuffer handle, const BufferDesc& desc, uint64_t offset)
{
    Buffer buffer;
    buffer.impl_ = std::make_unique<Buffer::Impl>();
    Buffer::Impl& b = *buffer.impl_;
    b.context = impl_.get();
    b.desc = desc;
    b.handle = handle;
    b.owned = false;
    b.offset = offset;
    // What the caller did to it before is not known here: the first barrier waits for everything.
    b.state.write_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    b.state.write_access = VK_ACCESS_2_MEMORY_WRITE_BIT;
    return buffer;
}

} // namespace gnomon::gpu
