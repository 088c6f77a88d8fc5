// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <volk.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::gpu {

using base::Size;
class Device;

/// All images are 2D (arrays); `cube` makes a 6n-layer image viewable as a cube.
struct ImageDesc {
    VkFormat format = VK_FORMAT_UNDEFINED;
    Size size;
    uint32_t layers = 1, mips = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool cube = false;
    std::string name;
};
uint64_t texel_bytes(VkFormat); ///< of a copy; of the depth aspect where there is one
bool is_depth(VkFormat);
bool has_stencil(VkFormat);

/// Where a buffer, or one layer and mip of an image, stands between pass lists: kept by its owner, changed by submit. The last write,
/// and the reads since, which a later write has to wait for.
struct BufferState {
    VkPipelineStageFlags2 write_stages = 0, read_stages = 0;
    VkAccessFlags2 write_access = 0, read_access = 0;
    bool operator==(const BufferState&) const = default;
};
struct SubresourceState : BufferState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool operator==(const SubresourceState&) const = default;
};
struct ImageState {
    uint32_t layers = 1, mips = 1;
    std::vector<SubresourceState> parts = std::vector<SubresourceState>(1); ///< one while uniform, else [layer * mips + mip]
    SubresourceState& part(uint32_t layer, uint32_t mip) { return parts.size() == 1 ? parts[0] : parts[layer * mips + mip]; }
};

/// Move-only owner; the memory is given back once the device is past its last use. Must not outlive its Device.
class Image {
public:
    Image();
    Image(Image&&) noexcept;
    Image& operator=(Image&&) noexcept;
    ~Image();
    const ImageDesc& desc() const;
    VkImage handle() const;
    uint64_t bytes() const; ///< of device memory
    explicit operator bool() const;
    /// A view of a range, made on first use and kept by the image.
    VkImageView view(
        VkImageViewType, uint32_t first_layer, uint32_t layer_count, uint32_t first_mip, uint32_t mip_count, VkImageAspectFlags) const;
    ImageState& state() const;

private:
    friend class Device;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

enum class Memory { device, upload, read_back }; ///< intent, not a memory type; upload and read_back are mapped

struct BufferDesc {
    uint64_t bytes = 0;
    VkBufferUsageFlags usage = 0; ///< storage, transfer and device address are always added
    Memory memory = Memory::device;
    std::string name;
};

class Buffer {
public:
    Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;
    ~Buffer();
    const BufferDesc& desc() const;
    VkBuffer handle() const;
    uint64_t offset() const; ///< of the first byte within handle(); 0 but for adopted ones
    uint64_t range() const; ///< from there on, in bytes or VK_WHOLE_SIZE
    VkDeviceAddress address() const;
    std::byte* mapped() const; ///< nullptr for device memory
    explicit operator bool() const;
    BufferState& state() const;

private:
    friend class Device;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Fixed samplers. compare_*: depth compare GREATER_OR_EQUAL (reversed depth: 1 = lit), border 0 (nothing there: lit).
enum class Sampler : uint8_t {
    nearest_clamp,
    linear_clamp,
    nearest_repeat,
    linear_repeat,
    nearest_mirror,
    linear_mirror,
    compare_nearest,
    compare_linear
};

/// All textures of a scene as one descriptor array: `layout(set = 2, binding = 0) uniform sampler2D textures[];`
class TextureTable {
public:
    TextureTable();
    TextureTable(TextureTable&&) noexcept;
    TextureTable& operator=(TextureTable&&) noexcept;
    ~TextureTable();
    VkDescriptorSet set() const;

private:
    friend class Device;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

struct BlasDesc {
    VkDeviceAddress positions; ///< 3 floats a vertex
    uint32_t vertex_stride = 12, vertex_count = 0;
    VkDeviceAddress indices; ///< uint32
    uint32_t triangle_count = 0;
    bool opaque = true; ///< false: any-hit or candidate handling (alpha mask)
    std::string name;
};

class AccelerationStructure {
public:
    AccelerationStructure();
    AccelerationStructure(AccelerationStructure&&) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&&) noexcept;
    ~AccelerationStructure();
    VkAccelerationStructureKHR handle() const;
    VkDeviceAddress address() const;
    uint64_t bytes() const;
    explicit operator bool() const;

private:
    friend class Device;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

struct TlasInstance {
    const AccelerationStructure* blas;
    float transform[12]; ///< rows of world_from_object, 3x4
    uint32_t custom_index; ///< 24 bits
    uint8_t mask = 0xff;
    uint32_t hit_group = 0;
};

} // namespace gnomon::gpu
