// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <cstdint>
#include <span>

namespace gnomon::truth {

/// Strata of the light, as many across as down, one jittered sample each. The jitter is a hash of (seed, pixel, stratum): pixels are
/// decorrelated, and any thread may compute any of them.
struct Strata {
    int columns, rows;
    uint64_t seed;
    /// At least `samples`, as a square; where the light has an image, columns and rows are more if need be, so that each texel holds as
    /// many strata as every other.
    Strata(int samples, uint64_t seed, glm::ivec2 texels = {1, 1});
    int count() const { return columns * rows; }
    vec2 point(uint64_t pixel, int column, int row) const;
};

struct Estimate {
    double mean = 0.0, variance = 0.0; ///< of the mean
};

/// From the value of each stratum, row by row, and its weight where they are not all 1 (their mean is 1). The variance of a stratified mean
/// is the sum over strata of their own variances / N^2, of which one sample tells nothing; but for a pair of strata E[(a - b)^2] = var a +
/// var b + (difference of their means)^2, so pairs of neighbours (along a snake through the rows) give an estimate that is too large rather
/// than too small. Of unequal weights a pair has the mean square.
Estimate estimate(std::span<const float> values, int columns, std::span<const float> weights = {});

} // namespace gnomon::truth
