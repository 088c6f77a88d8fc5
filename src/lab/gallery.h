// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::lab {

/// The README's grid: a thumbnail for each technique, by family, and a line on the scenes.
std::string picture_grid(const std::filesystem::path& root);

/// docs/gallery.md: each technique's picture with its cost and its error, by family, and the scenes.
std::string gallery(const std::filesystem::path& root);

/// docs/pictures/thumbnails/<id>.png: that part of the first panel of techniques/<id>/<id>.png where the error is largest. Returns those
/// that are not made from the present picture (more than rounding apart), and, unless `check`, makes them. Thumbnails of no technique are
/// listed and removed.
std::vector<std::filesystem::path> update_thumbnails(const std::filesystem::path& root, bool check);

/// techniques/<id>/results.json is what `gnomon picture` measured; null where there is none.
nlohmann::ordered_json measured(const std::filesystem::path& technique_folder);

} // namespace gnomon::lab
