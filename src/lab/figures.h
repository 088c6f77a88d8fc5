// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/slice.h"
#include "lab/stage.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

// A figures file (docs/experiments.md): pictures beside one another that show one thing, as papers have them, and the page that holds
// them.
namespace gnomon::lab {

enum class Show { lit, visibility, error, filter_error, slice, texel_footprint, texel_footprint_perspective, texel_footprint_projection };

struct FigurePanel {
    std::string label, technique; ///< technique: parse_choice, or "truth"
    Show show = Show::lit;
    truth::Quantity quantity = truth::Quantity::visibility; ///< of "truth"
    StageOptions stage;
    SliceOptions slice;
    std::string reference; ///< filter_error: what the technique is compared with
    float gain = 1; ///< errors: the largest shown is 1 / gain
    std::array<int, 4> crop{}; ///< x, y, width, height in pixels; a width of 0 = all
    int zoom = 1; ///< pixels to a side that one pixel becomes
};

struct Figure {
    std::string id, title, text;
    int columns = 3;
    std::vector<FigurePanel> panels;
};

struct Figures {
    std::string title, about;
    std::vector<Figure> figures;
    int truth_samples = 256;
};

/// Throws base::Error on what it cannot read, naming the place. Needs no device.
Figures read_figures(const std::filesystem::path&);

/// Writes a PNG for each panel and README.md, which is the page; returns the files.
std::vector<std::filesystem::path> draw_figures(gpu::Device&, const Figures&, const std::filesystem::path& folder);

} // namespace gnomon::lab
