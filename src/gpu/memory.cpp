// SPDX-License-Identifier: Apache-2.0
#include "gpu/memory.h"

#include "base/error.h"

#include <algorithm>

namespace gnomon::gpu {

namespace {

constexpr uint64_t block_bytes = uint64_t(64) << 20;
constexpr uint64_t own_block_above = uint64_t(16) << 20;

uint64_t align_up(uint64_t value, uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

double mebibytes(uint64_t bytes) { return double(bytes) / (1 << 20); }

} // namespace

struct MemoryBlock {
    VkDeviceMemory memory;
    uint32_t type;
    bool linear, own;
    std::byte* mapped;
    uint64_t size;
    Ranges ranges;
};

Ranges::Ranges(uint64_t size)
    : size_(size)
    , free_{{0, size}}
{
}

std::optional<uint64_t> Ranges::take(uint64_t size, uint64_t alignment)
{
    for (auto it = free_.begin(); it != free_.end(); ++it) {
        const auto [offset, length] = *it;
        const uint64_t begin = align_up(offset, std::max<uint64_t>(alignment, 1));
        if (begin + size > offset + length) continue;
        free_.erase(it);
        if (begin > offset) free_.emplace(offset, begin - offset);
        if (begin + size < offset + length) free_.emplace(begin + size, offset + length - begin - size);
        return begin;
    }
    return std::nullopt;
}

void Ranges::give(uint64_t offset, uint64_t size)
{
    auto after = free_.lower_bound(offset);
    if (after != free_.end() && offset + size == after->first) {
        size += after->second;
        after = free_.erase(after);
    }
    if (after != free_.begin()) {
        const auto before = std::prev(after);
        if (before->first + before->second == offset) {
            before->second += size;
            return;
        }
    }
    free_.emplace(offset, size);
}

bool Ranges::unused() const { return free_.size() == 1 && free_.begin()->second == size_; }

MemoryPool::MemoryPool(const VolkDeviceTable& vk, VkDevice device, const InstanceFunctions& instance, VkPhysicalDevice physical)
    : vk_(vk)
    , device_(device)
{
    instance.vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
    VkPhysicalDeviceMaintenance3Properties limits{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &limits};
    instance.vkGetPhysicalDeviceProperties2(physical, &all);
    largest_ = limits.maxMemoryAllocationSize;
}

MemoryPool::~MemoryPool()
{
    for (const auto& block : blocks_) vk_.vkFreeMemory(device_, block->memory, nullptr);
}

uint32_t MemoryPool::choose_type(const MemoryRequest& request) const
{
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    constexpr VkMemoryPropertyFlags mapped = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags required = request.memory == Memory::device ? 0 : mapped;
    const VkMemoryPropertyFlags wanted = request.memory == Memory::device ? local : request.memory == Memory::read_back ? cached : 0;
    const VkMemoryPropertyFlags unwanted = request.memory == Memory::device ? mapped
        : request.memory == Memory::upload                                  ? cached | local
                                                                            : local;
    uint32_t best = ~0u;
    int best_score = -1;
    for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
        if (!(request.needs.memoryTypeBits & (1u << i)) || (flags & required) != required) continue;
        if (flags & (VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD)) continue;
        const int score = ((flags & wanted) == wanted ? 2 : 0) + ((flags & unwanted) == 0 ? 1 : 0);
        if (score > best_score) best = i, best_score = score;
    }
    if (best == ~0u) base::fail("the device has no memory type for {}; choose another device with --device", request.name);
    return best;
}

void MemoryPool::out_of_memory(const MemoryRequest& request, uint64_t heap) const
{
    throw OutOfMemory(
        fmt::format("out of device memory: {} needs {:.1f} MiB, {:.1f} of {:.1f} MiB are taken; choose a smaller --size or a smaller map",
            request.name, mebibytes(request.needs.size), mebibytes(used_), mebibytes(heap)));
}

MemoryBlock& MemoryPool::add_block(uint32_t type, uint64_t size, bool own, const MemoryRequest& request)
{
    const uint64_t heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    if (request.needs.size > largest_)
        base::fail("{} needs {:.1f} MiB, more than the {:.1f} MiB that the device gives in one piece (maxMemoryAllocationSize); choose a "
                   "smaller --size, map or scene",
            request.name, mebibytes(request.needs.size), mebibytes(largest_));
    // A software driver maps more than there is and dies later: the heap's size is the limit.
    if (used_ + request.needs.size > heap) out_of_memory(request, heap);
    VkMemoryDedicatedAllocateInfo dedicated{VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO, nullptr, request.image, request.buffer};
    VkMemoryAllocateFlagsInfo flags{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO, own ? &dedicated : nullptr};
    flags.flags = request.linear ? VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT : 0;
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, &flags, size, type};
    VkDeviceMemory memory;
    if (vk_.vkAllocateMemory(device_, &info, nullptr, &memory) != VK_SUCCESS) out_of_memory(request, heap);
    void* mapped = nullptr;
    if (request.linear && (properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) {
        const VkResult result = vk_.vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) vk_.vkFreeMemory(device_, memory, nullptr);
        check(result, "vkMapMemory", request.name);
    }
    blocks_.push_back(
        std::make_unique<MemoryBlock>(MemoryBlock{memory, type, request.linear, own, static_cast<std::byte*>(mapped), size, Ranges(size)}));
    return *blocks_.back();
}

Allocation MemoryPool::allocate(const MemoryRequest& request)
{
    const uint32_t type = choose_type(request);
    const uint64_t size = request.needs.size;
    const bool own = size > own_block_above;
    MemoryBlock* block = nullptr;
    std::optional<uint64_t> offset;
    for (const auto& b : blocks_) {
        if (own || b->own || b->type != type || b->linear != request.linear) continue;
        offset = b->ranges.take(size, request.needs.alignment);
        if (!offset) continue;
        block = b.get();
        break;
    }
    if (!block) {
        block = &add_block(type, own ? size : block_bytes, own, request);
        offset = block->ranges.take(size, request.needs.alignment);
    }
    used_ += size;
    return {block->memory, *offset, size, block->mapped ? block->mapped + *offset : nullptr, block};
}

void MemoryPool::free(const Allocation& allocation)
{
    MemoryBlock* block = allocation.block;
    if (!block) return;
    used_ -= allocation.size;
    block->ranges.give(allocation.offset, allocation.size);
    if (!block->ranges.unused()) return;
    // One empty block of a kind stays, so that a lone resource made and freed in turn costs no driver call.
    const bool spare = std::any_of(blocks_.begin(), blocks_.end(), [&](const auto& b) {
        return b.get() != block && !b->own && b->type == block->type && b->linear == block->linear && b->ranges.unused();
    });
    if (block->own || spare) remove_block(block);
}

void MemoryPool::remove_block(MemoryBlock* block)
{
    vk_.vkFreeMemory(device_, block->memory, nullptr);
    std::erase_if(blocks_, [&](const auto& b) { return b.get() == block; });
}

} // namespace gnomon::gpu
