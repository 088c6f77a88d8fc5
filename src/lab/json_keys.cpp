// SPDX-License-Identifier: Apache-2.0
#include "lab/json_keys.h"

#include "base/error.h"
#include "base/json_depth.h"
#include "base/names.h"

#include <algorithm>

namespace gnomon::lab {

void known_keys(const nlohmann::ordered_json& object, const std::vector<std::string>& keys, const std::filesystem::path& file)
{
    if (!object.is_object())
        base::fail(
            "{}: an object with the keys {} is wanted where it says {}", file.string(), fmt::join(keys, ", "), object.dump().substr(0, 60));
    for (const auto& [key, value] : object.items())
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            base::fail("{}: {}", file.string(), base::unknown_name("key", key, keys));
}

nlohmann::ordered_json parse_json(std::string_view text, const std::filesystem::path& file)
{
    base::check_json_depth(text, file.string());
    return naming(file, [&] { return nlohmann::ordered_json::parse(text); });
}

int whole_number(const nlohmann::ordered_json& object, const char* key, int otherwise, int low, int high)
{
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_number_integer() || *found < low || *found > high)
        base::fail("\"{}\" takes a whole number from {} to {}, not {}", key, low, high, found->dump().substr(0, 40));
    return found->get<int>();
}

} // namespace gnomon::lab
