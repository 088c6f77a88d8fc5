// SPDX-License-Identifier: Apache-2.0
#include "base/json_depth.h"

#include "base/error.h"

namespace gnomon::base {

void check_json_depth(std::string_view text, std::string_view file)
{
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{'))
            ++depth;
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
        if (depth > deepest_json)
            fail("{} is no JSON to be read: its brackets are nested more than {} deep; the file is damaged", file, deepest_json);
    }
}

} // namespace gnomon::base
