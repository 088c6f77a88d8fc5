// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::lab {

/// Throws base::Error naming the file on a key of `object` that is not among these, and where it is no object.
void known_keys(const nlohmann::ordered_json& object, const std::vector<std::string>& keys, const std::filesystem::path& file);

/// The parsed text of a file. Throws base::Error naming the file where it is no JSON, or is nested absurdly deep.
nlohmann::ordered_json parse_json(std::string_view text, const std::filesystem::path& file);

/// A whole number of `object`, `otherwise` where the key is missing. Throws base::Error on anything else, and outside of low to high.
int whole_number(const nlohmann::ordered_json& object, const char* key, int otherwise, int low, int high);

/// What `read` returns. Whatever it finds wrong names the file, which deeper parts do not know.
template <class Read> auto naming(const std::filesystem::path& file, Read read)
{
    try {
        return read();
    } catch (const nlohmann::json::exception& e) {
        base::fail("{}: {}", file.string(), e.what());
    } catch (const base::Error& e) {
        const std::string what = e.what(), place = file.string();
        if (what.rfind(place, 0) == 0) throw;
        base::fail("{}: {}", place, what);
    }
}

} // namespace gnomon::lab
