// SPDX-License-Identifier: Apache-2.0
#include "lab/json_keys.h"

#include "base/error.h"
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

} // namespace gnomon::lab
