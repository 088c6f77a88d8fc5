// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

// Plots of what equations say, without a device: their numbers as CSV, their pictures as SVG, and a page.
namespace gnomon::lab {

struct Curve {
    std::string name;
    size_t color, dash; ///< see PlotSeries
    std::vector<double> y; ///< one for each x; not a number where the curve has none
};

struct Curves {
    std::string id, title, text; ///< text: Markdown, what to see
    std::string x_label, y_label;
    bool log_x, log_y;
    std::vector<double> x;
    std::vector<Curve> curves;
};

/// Perspective error of light maps and what lessens it (shadow/parts/sampling_error.h).
std::vector<Curves> error_curves();

/// A line of names, then one for each x; six significant digits, empty where there is no number.
std::string curves_csv(const Curves&);

/// <id>.csv and <id>.svg for each, and README.md; returns the files. What could not be plotted is a sentence in `notes`.
std::vector<std::filesystem::path> write_curves(
    const std::vector<Curves>&, const std::filesystem::path& folder, std::vector<std::string>& notes);

} // namespace gnomon::lab
