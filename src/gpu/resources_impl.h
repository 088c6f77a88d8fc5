// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/context.h"

namespace gnomon::gpu {

struct Image::Impl {
    struct View {
        VkImageViewType type;
        Range range;
        VkImageAspectFlags aspect;
        VkImageView view;
    };
    Context* context = nullptr;
    ImageDesc desc;
    VkImage handle = VK_NULL_HANDLE;
    bool owned = true;
    Allocation memory;
    ImageState state;
    std::vector<View> views;
    ~Impl();
};

struct Buffer::Impl {
    Context* context = nullptr;
    BufferDesc desc;
    VkBuffer handle = VK_NULL_HANDLE;
    bool owned = true;
    uint64_t offset = 0;
    VkDeviceAddress address = 0;
    Allocation memory;
    BufferState state;
    ~Impl();
};

struct TextureTable::Impl {
    Context* context = nullptr;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    ~Impl();
};

struct AccelerationStructure::Impl {
    Context* context = nullptr;
    VkAccelerationStructureKHR handle = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
    Buffer memory;
    ~Impl();
};

} // namespace gnomon::gpu
