// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace gnomon::base {

inline constexpr int deepest_json = 100; ///< no file of ours nests a tenth as deep

/// Throws Error naming `file` where arrays and objects are nested deeper. To be asked before a text is parsed: what was parsed is copied
/// and printed by functions that call themselves, and a file of a hundred thousand brackets would overflow the stack.
void check_json_depth(std::string_view text, std::string_view file);

} // namespace gnomon::base
