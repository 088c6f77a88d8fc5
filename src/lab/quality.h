// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "shadow/quality.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace gnomon::lab {

/// What one level means for all of a stage's lights. Throws base::Error where it means different techniques, since a picture is of one.
Choice quality_choice(const std::string& level, const gpu::Device&, std::span<const scene::Light>);

nlohmann::ordered_json qualities_json();
std::string qualities_text(); ///< for a terminal
std::string qualities_page(const shadow::QualityTable&); ///< a table in Markdown for each kind of light

/// The text of src/shadow/quality.json with its prices as the results of experiments/quality say, which lie below experiments/results.
/// Throws base::Error where an entry or the baseline was not measured.
std::string priced_qualities(const std::filesystem::path& root);

} // namespace gnomon::lab
