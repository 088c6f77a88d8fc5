// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace gnomon::view {

void tooltip(const std::string&); ///< wrapped
/// True where another entry was chosen.
bool combo(const char* label, int& index, const std::vector<std::string>& names);

} // namespace gnomon::view
