// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"
#include "shaders/n_buffer.shared.h"

#include <cstdint>

// Windows of 2^level texels a side around every texel of a map: N-buffers (Décoret 2005), whose windows begin at their texel, multiscale
// maps (Schwarz and Stamminger 2007), whose windows are centred, and Y maps (Schwarz and Stamminger 2008), which hold them of a coarser
// level only. Windows are clipped to the image: what lies outside has no value. Lookups: shaders/n_buffer.glsl.
namespace gnomon::shadow::parts {

struct NBuffer {
    gpu::ImageId image; ///< 2D array of levels * layers, each of the map's full size
    shaders::NBuffer constants;
};

/// Levels for rectangles whose short side has up to `side` texels.
uint32_t n_buffer_levels(int side);

/// RG32F of least and greatest values of the first channel of a float or depth image. By default there are levels for any rectangle within
/// it.
NBuffer build_min_max_n_buffer(gpu::PassList&, gpu::ImageId from, uint32_t levels = ~0u);
NBuffer build_multiscale_map(gpu::PassList&, gpu::ImageId from, uint32_t levels = ~0u);

/// Of level `mip` of a pyramid of least and greatest values (parts/pyramid.h).
NBuffer build_multiscale_map_of(gpu::PassList&, gpu::ImageId pyramid, uint32_t mip);

/// Means of `channels` (1, 2 or 4) of a float image, in 32-bit float, or in `format`, which rounds at each level.
NBuffer build_mean_n_buffer(gpu::PassList&, gpu::ImageId from, int channels, uint32_t levels = ~0u);
NBuffer build_mean_n_buffer(gpu::PassList&, gpu::ImageId from, VkFormat format, uint32_t levels = ~0u);

struct YMap {
    gpu::ImageId pyramid; ///< build_min_max_pyramid of coarseness + 1 levels
    NBuffer coarse; ///< multiscale map of the last of them
};
/// A 4^coarseness-th of the multiscale map's memory, for windows that are up to 2^coarseness - 1 texels too large at each end (twice that
/// at the right and lower rim, where the last texel of an odd level holds what is left).
YMap build_y_map(gpu::PassList&, gpu::ImageId from, uint32_t coarseness = 2);

} // namespace gnomon::shadow::parts
