// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <string>

// The README of an export, chapter by chapter; each reads the recipe (passes.json) alone.
namespace gnomon::lab {

std::string readme_conventions(const nlohmann::ordered_json& recipe);
std::string readme_resources(const nlohmann::ordered_json& recipe);
std::string readme_constants(const nlohmann::ordered_json& recipe);
std::string readme_passes(const nlohmann::ordered_json& recipe);

std::string cell(std::string); ///< safe within a table's cell
std::string numbers(const nlohmann::ordered_json& array, const char* between = ", ");
/// "map_size = 2048" of a specialisation constant or a constants' value: floats as floats.
std::string spec_value(const std::string& type, uint32_t bits);
std::string members_text(const nlohmann::ordered_json& members); ///< "vec4 row_x, uint ids[]"
std::string image_size(const nlohmann::ordered_json& image);

} // namespace gnomon::lab
