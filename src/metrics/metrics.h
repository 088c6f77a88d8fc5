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
/// All numbers are over scored pixels (none scored: 0); of three channels the mean is taken, in mae, rms and max (there the largest) that
/// of the channels' own errors. A value of `test` that is not finite counts as the farthest one from truth.
///
/// | id | light | meaning |
/// | wrong_pixels | hard | fraction with |test - truth| > 0.5; a filtered test of exactly 0.5 is right either way |
/// | acne | hard | wrong and darker; soft: truth >= 0.999 and test < 0.9 |
/// | leak | hard | wrong and lighter; soft: truth <= 0.001 and test > 0.1 |
/// | wrong_outside_band | hard | fraction that is wrong although all scored pixels of its 3x3 neighbourhood have the same truth |
/// | acne_outside_band, leak_outside_band | hard | the darker and the lighter ones of these |
/// | contact_gap | hard | pixels, at most 32, that are wrong and lighter in a run of scored pixels whose truth is dark: mean over the
/// runs of all rows and columns. Where a bias moves a shadow off its caster, the width of the lit gap |
/// | edge_displacement | hard | pixels from each edge of one picture to the nearest of the other, at most 32; mean over both ways |
/// | mae, rms, max, bias | both | of test - truth |
/// | bias_penumbra, bias_outside | soft | bias where truth is inside (0.001, 0.999), and elsewhere |
/// | penumbra_width | soft | sum of |test - truth| / sum of truth, of widths from 10 % to 90 % along rows and columns; none found: all of
/// it | | banding | soft | within the true penumbra: mean |second difference| along rows and columns of the error's 5x5 median | | grain |
/// soft | there: mean difference of the error to that median | | noise | soft | root of the mean variance of truth: differences below it
/// say nothing |
const std::vector<Metric>& metrics();

/// All metrics that apply.
std::map<std::string, double> measure(const Comparison&);

/// The same pixels against a reference technique's image, which stands in the place of `truth`: the error of filtering alone.
/// filter_mae, filter_rms, filter_max, filter_bias, filter_leak (mean of what is lighter), filter_dark (of what is darker).
const std::vector<Metric>& filter_metrics();
std::map<std::string, double> measure_filter(const Comparison&);

/// FLIP (Andersson et al. 2020, LDR): mean of the error map; pictures are display-referred linear RGB in [0,1].
double flip(const base::Picture& test, const base::Picture& truth, base::Picture* error_map = nullptr, float pixels_per_degree = 67.0f);

/// Signed error test - truth as a picture to look at: blue = too dark (false shadow), white = equal, red = too light (leak), grey
/// = not scored; with a legend strip below. Display colours: write with Encoding::linear.
base::Picture signed_heat_map(const Comparison&, float range = 1.0f);
std::vector<std::string> heat_map_colors(); ///< "#rrggbb" of its ramp, from too dark to too light, at even steps

} // namespace gnomon::metrics
