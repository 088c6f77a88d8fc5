// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::lab {

/// What `./dev robustness` left in experiments/results/reliability, as the tables of docs/reliability.md.
std::string reliability_tables(const std::filesystem::path& root);

} // namespace gnomon::lab
