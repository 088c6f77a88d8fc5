// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_states.h"

namespace gnomon::shadow::parts {

VkPipelineColorBlendAttachmentState volume_adding()
{
    VkPipelineColorBlendAttachmentState add{};
    add.blendEnable = VK_TRUE;
    add.colorWriteMask = 0xf;
    add.srcColorBlendFactor = add.dstColorBlendFactor = add.srcAlphaBlendFactor = add.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    add.colorBlendOp = add.alphaBlendOp = VK_BLEND_OP_ADD;
    return add;
}

gpu::DepthTarget volume_stencil(gpu::ImageId image, gpu::Load load, bool zfail)
{
    const auto counting = [](VkStencilOp op) {
        return VkStencilOpState{VK_STENCIL_OP_KEEP, op, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_ALWAYS, 0xff, 0xff, 0};
    };
    const VkStencilOpState up = counting(VK_STENCIL_OP_INCREMENT_AND_WRAP), down = counting(VK_STENCIL_OP_DECREMENT_AND_WRAP);
    return {.image = image,
        .load = load,
        .write = false,
        .compare = VK_COMPARE_OP_ALWAYS,
        .stencil = true,
        .front = zfail ? down : up,
        .back = zfail ? up : down};
}

gpu::DepthTarget volume_depth_test(gpu::ImageId depth, bool zfail)
{
    return {
        .image = depth, .load = gpu::Load::keep, .write = false, .compare = zfail ? VK_COMPARE_OP_LESS_OR_EQUAL : VK_COMPARE_OP_GREATER};
}

gpu::DepthTarget volume_where_one(gpu::ImageId image)
{
    const VkStencilOpState is_one{VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP, VK_STENCIL_OP_KEEP, VK_COMPARE_OP_EQUAL, 0xff, 0, 1};
    return {.image = image,
        .load = gpu::Load::keep,
        .write = false,
        .store = false,
        .compare = VK_COMPARE_OP_ALWAYS,
        .stencil = true,
        .front = is_one,
        .back = is_one};
}

} // namespace gnomon::shadow::parts
