// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"

#include <cstdint>
#include <span>

// Pyramids of levels that halve the size, rounded down, as Vulkan's mips do: of means (Williams 1983) and of least and greatest
// values (hierarchical z-buffers, Greene et al. 1993). All layers of an image at once. Lookups: shaders/pyramid.glsl.
namespace gnomon::shadow::parts {

/// Levels down to 1 x 1.
uint32_t pyramid_levels(gpu::Size);

/// Fills mips 1 and on from mip 0 with means; any float format. Every texel is the mean over its even share of the level above, also where
/// that has an odd size; so the last of all levels is the mean of the image.
void fill_mean_pyramid(gpu::PassList&, gpu::ImageId);

/// RG32F of least (r) and greatest (g) values of the first channel of a float or depth image. Texel i of level l covers the texels from
/// 2^l i to below 2^l (i + 1), the last one all that is left. `levels` from 1; at most pyramid_levels.
gpu::ImageId build_min_max_pyramid(gpu::PassList&, gpu::ImageId from, uint32_t levels = ~0u);
/// The same of several images of one size, whose layers follow one another.
gpu::ImageId build_min_max_pyramid(gpu::PassList&, std::span<const gpu::ImageId> from, uint32_t levels = ~0u);

} // namespace gnomon::shadow::parts
