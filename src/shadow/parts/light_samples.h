// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <cstdint>
#include <vector>

// Points on a light, for methods that keep one bit for each (Schwarz and Stamminger 2007, "Bitmask soft shadows"), with tables that give
// the bits inside any rectangle. Lookups: shaders/light_samples.glsl.
namespace gnomon::shadow::parts {

/// Sample points lie at the middles of a grid of so many cells a side over [-1, 1]^2: sides of rectangles are looked up by cell.
inline constexpr int light_sample_grid = 256;

struct LightSamples {
    std::vector<glm::ivec2> cells; ///< of the grid, by rising x: bit i of the mask is sample i
    /// For each of the grid's 257 cell borders: how many samples lie left of it; then, as masks, which ones lie below it.
    std::vector<uint32_t> table;
};

/// 64 or 256 samples with equal shares of the square or of its inscribed disk: jittered in 8 x 8 or 16 x 16 cells so that, on the square,
/// each row and each column of the full grid of samples holds one (Kensler 2013, "Correlated multi-jittered sampling"). An edge along an
/// axis then passes them one by one.
LightSamples light_samples(int count, bool disk);

} // namespace gnomon::shadow::parts
