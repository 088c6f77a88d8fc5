// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::base {

/// The candidates nearest to `name` by edit distance (at most three, none that shares nothing with it).
std::vector<std::string> near_names(std::string_view name, std::span<const std::string> candidates);

/// "unknown WHAT 'NAME'; did you mean 'a' or 'b'?" with all candidates listed where none is near. For errors.
std::string unknown_name(std::string_view what, std::string_view name, std::span<const std::string> candidates);

} // namespace gnomon::base
