// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/experiment.h"

#include <nlohmann/json.hpp>

// The parts of read_experiment.
namespace gnomon::lab {

using Json = nlohmann::ordered_json;

/// A value of an axis or of a "where", as the text that columns hold.
std::string scalar_text(const Json&);

/// The values of all axes in one combination.
using AxisValues = std::map<std::string, Json>;

/// Replaces $name in a string by the axis' value; a string that is nothing else becomes the value itself. Objects and arrays likewise.
/// Throws base::Error on a name that is no axis; adds those that are used to `used`.
Json substituted(const Json&, const AxisValues&, std::vector<std::string>& used);

/// Fills `cells` from the file's scenes, cameras, lights, sizes, axes and techniques; keys and the names of default cameras and lights are
/// left for `open_stages`.
void expand(const Json&, Experiment&);
std::string scene_text(const Cell&); ///< equal for cells of one scene
std::string stage_text(const Cell&); ///< equal for cells of one stage

/// Opens every scene, camera and light once.
void open_stages(Experiment&);

/// Fills metrics, tables and plots, and checks their columns. Cells have their columns.
void read_outputs(const Json&, Experiment&);

/// The keys, when everything else is there.
void finish_keys(Experiment&);

} // namespace gnomon::lab
