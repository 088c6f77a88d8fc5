// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"
#include "scene/math.h"

#include <vector>

// Summed-area tables (Crow 1984): the sum over any rectangle of texels by four fetches, whatever its size. The image is one texel
// wider and higher than the source: entry (x, y) is the sum over columns < x and rows < y, so that no fetch needs a border.
// Lookups: shaders/summed_area_table.glsl.
namespace gnomon::shadow::parts {

/// Sums in 32-bit float of `channels` (1, 2 or 4) of a sampled float or depth image with any number of layers.
///
/// A box sum is as wrong as its four entries are rounded, which single texels of large images show: of random values in [0, 1], 512 x 512,
/// by 0.013. `centre` is taken off every texel (the caller adds it to the means again): entries then grow like the deviation from it and
/// not like the area, and the same texels are off by 8e-6. Whole numbers are exact while no sum reaches 2^24.
gpu::ImageId build_float_sums(gpu::PassList&, gpu::ImageId from, int channels, vec4 centre = vec4(0));

/// Sums in 32-bit unsigned integers of values in [0, 1] (others are clamped), rounded to multiples of 1 / (2^bits - 1), bits from 1 to 24.
/// The table may wrap around as often as it likes: a box sum, being taken modulo 2^32 too, is exact as long as it is below 2^32 itself,
/// that is for windows of up to 2^(32 - bits) texels.
gpu::ImageId build_integer_sums(gpu::PassList&, gpu::ImageId from, int channels, int bits);

/// Sums of 32-bit words, four a texel, in a table of `layers` layers. The compute shader `rows` makes the words out of `sources` (its first
/// bindings) and writes their running sums by src/shadow/parts/summed_area_scan.glsl to the binding after them.
gpu::ImageId build_word_sums(
    gpu::PassList&, const std::vector<gpu::Binding>& sources, gpu::Size, uint32_t layers, const char* rows, gpu::Constants);

/// The most bits with which sums over windows of up to `texels` texels are exact.
int integer_sum_bits(double texels);

/// The value of one count, for the lookups of integer sums.
inline float integer_sum_step(int bits) { return 1.0f / float((1 << bits) - 1); }

} // namespace gnomon::shadow::parts
