// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/experiment.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::lab {

struct PlotPoint {
    std::string label; ///< x as text, where it has words
    double x, y, deviation; ///< x: not a number where it has words
    std::string note{}; ///< written beside the mark
};

struct PlotSeries {
    std::string name;
    size_t color, dash; ///< counted up; the same colour for what belongs together
    bool joined; ///< by lines
    std::vector<PlotPoint> points;
    bool marked = true; ///< a mark at each point
};

/// Draws `file`, an SVG, by gnuplot: titles, names and scales of `spec`. "" or, in a sentence, why there is none.
std::string draw_series(const PlotSpec& spec, std::vector<PlotSeries>, const std::filesystem::path& file);

} // namespace gnomon::lab
