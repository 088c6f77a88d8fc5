// SPDX-License-Identifier: Apache-2.0
#include "shadow/technique.h"

namespace gnomon::shadow {

gpu::ImageId inspection_image(gpu::PassList& passes, const Frame& frame)
{
    return passes.transient({VK_FORMAT_R32_SFLOAT, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "inspection"});
}

} // namespace gnomon::shadow
