// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/plot.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

struct PlotMark {
    double x, y; ///< pixels from the plot's lower left corner
    std::string text;
};

struct PlotLine {
    double x0, y0, x1, y1; ///< pixels
};

/// Where a mark's text stands: its left end's middle, and whether it is so far off that a line must lead to it.
struct LabelPlace {
    double x, y;
    bool line;
};

/// A place for each text that covers no mark, line or other text and stays in the plot, near its mark; earlier marks choose first. None
/// where there is no room within reach.
std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<PlotMark>&, const std::vector<PlotLine>&, double width, double height);

/// Of a plot whose points have notes: gnuplot's commands that fix its margins and ranges, so that pixels are known, and write the notes.
std::string label_script(const PlotSpec&, const std::vector<PlotSeries>&);

/// Inside double quotes of gnuplot.
std::string plot_text(const std::string&);

} // namespace gnomon::lab
