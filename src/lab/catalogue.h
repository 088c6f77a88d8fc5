// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"

#include <nlohmann/json.hpp>

#include <string>

// What there is to choose from, as JSON: `gnomon list --json` and the Python module.
namespace gnomon::lab {

/// {name, default, unit, help} of each parameter, with `choices`, or `range` of numbers; of a flag neither.
nlohmann::ordered_json parameters_json(const shadow::TechniqueInfo&);

/// All techniques with their parameters. `device`: "unavailable" says why it cannot run one ("" where it can); null: there is none,
/// and `why` stands there.
nlohmann::ordered_json techniques_json(const gpu::Device* device, const std::string& why = {});

/// {name, driver, software, missing} of every device.
nlohmann::ordered_json devices_json();

/// The built-in scenes, with the names of their cameras and lights.
nlohmann::ordered_json scenes_json();

} // namespace gnomon::lab
