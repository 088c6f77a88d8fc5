// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "lab/stage.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

// An experiment file (docs/experiments.md): techniques, parameters, scenes, lights, cameras and sizes, and every combination of them.
namespace gnomon::lab {

/// Which rows: a row is taken where the text of each of these columns is one of those named.
using Where = std::map<std::string, std::vector<std::string>>;

/// Rows that agree in `rows` are one, their numbers the mean of theirs.
struct TableSpec {
    /// A row that was not measured here: a text for each of `rows`, a number or nothing for each of `columns`.
    struct Published {
        std::vector<std::string> texts;
        std::vector<std::optional<double>> numbers;
    };
    std::string title;
    std::vector<std::string> rows, columns;
    Where where;
    std::vector<std::string> labels; ///< headings of `columns`
    std::vector<Published> published; ///< below the measured rows
};

struct PlotSpec {
    std::string file; ///< without ".svg"
    std::string title, x, y, x_label, y_label;
    std::vector<std::string> series;
    std::vector<std::string>
        points; ///< where x is a number that was measured: runs that agree in these are one point, their mean; empty = each its own
    Where where;
    bool log_x = false, log_y = false;
    double y_floor = 0; ///< above 0: smaller values are drawn at it, and the axis says so (0 has no place on a logarithmic axis)
};

/// One combination.
struct Cell {
    std::map<std::string, std::string> columns; ///< what it is, as text: technique, scene, camera, light, size and each axis
    StageOptions stage;
    Choice choice;
    std::optional<Choice> reference;
    std::string motion; ///< parse_motion; empty = no sequence is measured
    std::string key; ///< hash of all that the result follows from but device and program; equal cells are one run
};

struct Experiment {
    std::string name, title, about;
    std::filesystem::path file;
    std::vector<std::string> axes;
    std::vector<Cell> cells; ///< those of one stage follow one another
    std::vector<std::string> metrics; ///< what its tables show
    int truth_samples = 256, warm_up = 1, repeats = 3;
    uint32_t frame_index = 0;
    bool flip = false; ///< whether FLIP, which has to light the pictures, is asked for
    std::vector<TableSpec> tables;
    std::vector<PlotSpec> plots;
};

/// Reads, expands and checks: every technique, parameter, scene, light, camera, metric and column is looked up, so that a sweep does not
/// fail hours later on a name. Throws base::Error. Needs no device.
Experiment read_experiment(const std::filesystem::path&);

/// Column names that a row has besides the axes.
const std::vector<std::string>& identity_columns(); ///< texts: technique, scene, camera, light, size
const std::vector<std::string>& number_columns(); ///< ms, ms_deviation, mib, ..., and every metric; "pass:NAME" is one too, and
                                                  ///< "pass:NAME+START*", the sum of passes by name or by their names' beginning;
                                                  ///< "count:NAME" is one that the technique counts

bool is_number_column(const std::string&);

} // namespace gnomon::lab
