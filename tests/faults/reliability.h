// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

// Short runs belong to ctest; `./dev robustness` sets GNOMON_RELIABILITY to the folder of the results and runs everything at full length.
namespace gnomon::tests {

std::optional<std::filesystem::path> results_folder();
inline bool at_full_length() { return results_folder().has_value(); }

/// Appends one line of what was done to `file`.json (a list under "rows") of the results folder; nothing in a short run.
void record(const std::string& file, const nlohmann::ordered_json& row);

} // namespace gnomon::tests
