// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

// What the faces of shadow volumes are drawn with.
namespace gnomon::shadow::parts {

VkPipelineColorBlendAttachmentState volume_adding();
/// Counts in the stencil of `image`, which is 0 at first: what is before the receiver, or by z-fail what is beyond it.
gpu::DepthTarget volume_stencil(gpu::ImageId image, gpu::Load, bool zfail);
/// Lets through what lies before the receivers in `depth`, or by z-fail what lies beyond them or level with them, as their own triangles.
gpu::DepthTarget volume_depth_test(gpu::ImageId depth, bool zfail);
/// Lets through what lies where the stencil of `image` is 1.
gpu::DepthTarget volume_where_one(gpu::ImageId image);

} // namespace gnomon::shadow::parts
