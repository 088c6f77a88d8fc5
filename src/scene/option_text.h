// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The form NAME,key=value,key=value in which the command line states lights and cameras.
namespace gnomon::scene {

struct OptionText {
    std::string name; ///< what stands before the first key; it may hold commas ("nave, centre line")
    std::vector<std::pair<std::string, std::string>> pairs;
};

/// Throws Error where something other than key=value follows the first key.
OptionText split_options(std::string_view text);

/// Where a value stands, for errors: "light 'sun,angle=x': angle".
struct OptionPlace {
    std::string_view what, text, key;
};

/// A finite number in [low, high]; Error names the range and the unit.
float option_number(const OptionPlace&, std::string_view value, float low, float high, std::string_view unit = "");
/// x/y/z, each finite and at most 1e9.
vec3 option_vec3(const OptionPlace&, std::string_view value);
/// A point so stated, counted from `origin` (scene/rebase.h) without rounding it far away first.
vec3 option_point(const OptionPlace&, std::string_view value, vec3 origin);
/// r/g/b (linear, from 0) or #rrggbb (sRGB), as linear.
vec3 option_color(const OptionPlace&, std::string_view value);
/// Throws Error with the near names, or with all keys where none is near.
[[noreturn]] void unknown_key(const OptionPlace&, std::span<const std::string> keys);

} // namespace gnomon::scene
