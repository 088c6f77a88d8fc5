// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

#include <span>
#include <string_view>
#include <vector>

// The one table that turns declared uses into barriers. Pure: tested without a GPU.
namespace gnomon::gpu {

enum class PassKind : uint8_t { compute, raster, trace, transfer };

struct Access {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 access = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED; ///< for images
    bool writes = false;
    bool needs_content = false; ///< what was written before is read: refused where nothing was
};
Access access_of(Use, PassKind, bool depth_format);

/// What has to stand before a use, given where the resource is; updates the state. Read after read needs nothing unless the layout
/// changes (then the stages are joined); a write waits for all earlier readers and writers.
struct Barrier {
    bool needed = false;
    VkPipelineStageFlags2 src_stages = 0, dst_stages = 0;
    VkAccessFlags2 src_access = 0, dst_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED, new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool operator==(const Barrier&) const = default;
};
Barrier transition(SubresourceState&, const Access&);
Barrier transition(BufferState&, const Access&);

struct Range {
    uint32_t first_layer = 0, layers = 1, first_mip = 0, mips = 1;
    bool operator==(const Range&) const = default;
};

struct ImageUse {
    uint32_t image; ///< index into the states
    Range range;
    Access access;
    std::string_view name; ///< for errors
};
struct ImageBarrier {
    uint32_t image;
    Range range;
    Barrier barrier;
};

struct BufferUse {
    uint32_t buffer;
    Access access;
};
struct BufferBarrier {
    uint32_t buffer;
    Barrier barrier;
};

/// All barriers before one pass; the states become those during the pass. Uses of the same layer and mip in one pass are joined, and
/// two reads with different layouts meet in GENERAL: `access.layout` of each use is the layout it then has. A write beside another
/// use in another layout, or a read of what nothing wrote, throws std::logic_error naming pass and image.
std::vector<ImageBarrier> plan_images(std::string_view pass, std::span<ImageUse>, std::span<ImageState>);
std::vector<BufferBarrier> plan_buffers(std::span<const BufferUse>, std::span<BufferState>);

/// One layout for a range, outside of pass lists.
std::vector<ImageBarrier> transition(ImageState&, const Range&, const Access&);
Range whole(const ImageState&);

} // namespace gnomon::gpu
