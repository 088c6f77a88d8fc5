// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <cstdint>
#include <span>

namespace gnomon::truth {

/// n x n strata of the light, one jittered sample each. The jitter is a hash of (seed, pixel, stratum): pixels are decorrelated, and
/// any thread may compute any of them.
struct Strata {
    int side; ///< n
    uint64_t seed;
    /// At least `samples`, as a square.
    Strata(int samples, uint64_t seed);
    int count() const { return side * side; }
    vec2 point(uint64_t pixel, int column, int row) const;
};

struct Estimate {
    double mean = 0.0, variance = 0.0; ///< of the mean
};

/// From the value of each stratum, row by row. The variance of a stratified mean is the sum over strata of their own variances / N^2,
/// of which one sample tells nothing; but for a pair of strata E[(a - b)^2] = var a + var b + (difference of their means)^2, so pairs
/// of neighbours (along a snake through the rows) give an estimate that is too large rather than too small.
Estimate estimate(std::span<const float> values, int side);

} // namespace gnomon::truth
