// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::lab {

/// Throws base::Error naming the file on a key of `object` that is not among these, and where it is no object.
void known_keys(const nlohmann::ordered_json& object, const std::vector<std::string>& keys, const std::filesystem::path& file);

} // namespace gnomon::lab
