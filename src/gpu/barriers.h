// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

#include <vector>

// The one table that turns declared uses into barriers. Pure: tested without a GPU.
namespace gnomon::gpu {

enum class PassKind : uint8_t { compute, raster, trace, transfer };

struct Access {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
    VkImageLayout layout; ///< for images
    bool writes;
};
Access access_of(Use, PassKind, bool depth_format);

/// What has to stand before a use, given where the resource is; updates `state`. Read after read needs nothing unless the layout
/// changes (then the stages are joined); a write waits for all earlier readers and writers.
struct Barrier {
    bool needed = false;
    VkPipelineStageFlags2 src_stages = 0, dst_stages = 0;
    VkAccessFlags2 src_access = 0, dst_access = 0;
    VkImageLayout old_layout = VK_IMAGE_LAYOUT_UNDEFINED, new_layout = VK_IMAGE_LAYOUT_UNDEFINED;
};
Barrier transition(ImageState&, const Access&);
Barrier transition(BufferState&, const Access&);

} // namespace gnomon::gpu
