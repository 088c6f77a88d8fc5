// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <volk.h>

namespace gnomon::shadow::parts {

/// 32-bit float of 1, 2 or 4 channels.
inline VkFormat float_format(int channels)
{
    if (channels == 1) return VK_FORMAT_R32_SFLOAT;
    if (channels == 2) return VK_FORMAT_R32G32_SFLOAT;
    if (channels == 4) return VK_FORMAT_R32G32B32A32_SFLOAT;
    base::fail("a filtered image has 1, 2 or 4 channels, not {}; choose one of these", channels);
}

/// 32-bit unsigned integer of 1, 2 or 4 channels.
inline VkFormat integer_format(int channels)
{
    const VkFormat format = float_format(channels);
    return format == VK_FORMAT_R32_SFLOAT   ? VK_FORMAT_R32_UINT
        : format == VK_FORMAT_R32G32_SFLOAT ? VK_FORMAT_R32G32_UINT
                                            : VK_FORMAT_R32G32B32A32_UINT;
}

} // namespace gnomon::shadow::parts
