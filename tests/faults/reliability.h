// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

// Short runs belong to ctest; `./dev robustness` sets GNOMON_RELIABILITY to the folder of the results and runs everything at full length.
namespace gnomon::tests {

std::optional<std::filesystem::path> results_folder();
inline bool at_full_length() { return results_folder().has_value(); }

/// How far apart the places of a long series are that are tried: 1, all of them, in a full run (GNOMON_RELIABILITY_STEP, for machines with
/// less time), else so that it takes about `short_runs`.
uint64_t step_of(uint64_t places, uint64_t short_runs);

/// Appends one line of what was done to `file`.json (a list under "rows") of the results folder; nothing in a short run.
void record(const std::string& file, const nlohmann::ordered_json& row);

} // namespace gnomon::tests
