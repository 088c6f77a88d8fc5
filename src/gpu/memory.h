// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/functions.h"
#include "gpu/resources.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::gpu {

/// The free ranges of one block of memory: first fit, neighbours join. Pure: tested without a GPU.
class Ranges {
public:
    explicit Ranges(uint64_t size);
    std::optional<uint64_t> take(uint64_t size, uint64_t alignment); ///< the offset
    void give(uint64_t offset, uint64_t size);
    bool unused() const;

private:
    uint64_t size_;
    std::map<uint64_t, uint64_t> free_; ///< offset -> size
};

struct MemoryBlock;
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t offset = 0, size = 0;
    std::byte* mapped = nullptr;
    MemoryBlock* block = nullptr;
};

/// What an allocation is for. A linear resource (buffer) and an optimal image never share a block, so that
/// bufferImageGranularity needs no thought.
struct MemoryRequest {
    VkMemoryRequirements needs;
    Memory memory = Memory::device;
    bool linear = true;
    VkImage image = VK_NULL_HANDLE; ///< the resource itself, for dedicated memory
    VkBuffer buffer = VK_NULL_HANDLE;
    std::string_view name;
};

/// Blocks of 64 MiB per memory type; resources above 16 MiB have their own.
class MemoryPool {
public:
    MemoryPool(const VolkDeviceTable&, VkDevice, const InstanceFunctions&, VkPhysicalDevice);
    ~MemoryPool();
    MemoryPool(const MemoryPool&) = delete;
    MemoryPool& operator=(const MemoryPool&) = delete;

    Allocation allocate(const MemoryRequest&);
    void free(const Allocation&);
    uint64_t used() const { return used_; }

private:
    uint32_t choose_type(const MemoryRequest&) const;
    MemoryBlock& add_block(uint32_t type, uint64_t size, bool own, const MemoryRequest&);
    void remove_block(MemoryBlock*);
    [[noreturn]] void out_of_memory(const MemoryRequest&, uint64_t heap) const;

    const VolkDeviceTable& vk_;
    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{};
    uint64_t largest_ = 0, used_ = 0;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

} // namespace gnomon::gpu
