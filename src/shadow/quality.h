// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/technique.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Ready choices: for every kind of light a technique with parameters at each of four levels, and what it costs and errs
// (src/shadow/quality.json, which is part of the library; docs/quality.md).
namespace gnomon::shadow {

enum class Level : uint8_t { low, medium, high, exact };
inline constexpr int level_count = 4;
std::string_view level_name(Level);
Level parse_level(std::string_view); ///< throws base::Error, which lists them

/// What an entry was measured at, mean over its scenes.
struct Price {
    std::string where; ///< scenes and size
    double time = 0; ///< its own passes' time as a multiple of the baseline's in the same run
    double least_time = 0, most_time = 0; ///< over the scenes
    double mib = 0; ///< device memory beyond its image
    double mae = 0; ///< mean absolute error of the visibility against the truth
    std::optional<double> wrong_pixels; ///< fraction that is on the wrong side; lights without area
};

struct Quality {
    scene::LightKind light;
    bool area; ///< of lights that are scene::Light::soft(); false: of those without area
    Level level;
    const TechniqueInfo* technique;
    ParamValues params;
    std::optional<Price> price;
};

struct QualityTable {
    std::string measured; ///< two sentences: on which device, and what the numbers are
    std::string baseline; ///< what a time of 1 is
    std::vector<Quality> entries; ///< by light, area and level; of one level, in the order in which they are to be tried
};

/// The table that this library was built with.
const QualityTable& qualities();
/// From the text of src/shadow/quality.json. Throws base::Error where an entry names what does not exist, or a technique that does not
/// claim its light.
QualityTable parse_qualities(const std::string& text);

/// The first entry of that level for the light's kind that this device can run. Throws base::Error with the techniques' reasons where
/// there is none.
const Quality& choose_quality(Level, const gpu::Device&, const scene::Light&);

} // namespace gnomon::shadow
