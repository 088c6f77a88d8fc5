// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

// Measures on pictures. Knows no scene and no Vulkan.
namespace gnomon::metrics {

/// One comparison. `test`, `truth`, `variance` have 1 or 3 channels and one size. `mask` has an entry a pixel: 0 = not scored
/// (background, or another primitive in raster and rays).
struct Comparison {
    const base::Picture& test;
    const base::Picture& truth;
    const base::Picture& variance; ///< of truth's mean; may be empty (all 0)
    const std::vector<uint8_t>& mask;
    bool hard = false; ///< the light has no area: truth is 0 or 1
};

struct Metric {
    std::string_view id, unit, help;
    bool hard, soft; ///< for which lights it is reported
    double (*measure)(const Comparison&);
};
/// wrong_pixels, acne, leak (fractions of scored pixels; acne: test darker where truth is lit; leak: test lighter where truth is dark),
/// wrong_outside_band (hard: wrong pixels with no true edge within the 3x3 neighbourhood, fraction), edge_displacement (pixels),
/// mae, rms, max, bias (test - truth, mean), bias_penumbra, bias_outside, noise (RMS standard error of truth).
const std::vector<Metric>& metrics();

/// All metrics that apply.
std::map<std::string, double> measure(const Comparison&);

/// FLIP (Andersson et al. 2020, LDR): mean of the error map; pictures are display-referred linear RGB in [0,1].
double flip(const base::Picture& test, const base::Picture& truth, base::Picture* error_map = nullptr, float pixels_per_degree = 67.0f);

/// Signed error test - truth as a picture to look at: blue = too dark (false shadow), white = equal, red = too light (leak), grey
/// = not scored; with a legend strip below. Display colours: write with Encoding::linear.
base::Picture signed_heat_map(const Comparison&, float range = 1.0f);

} // namespace gnomon::metrics
