// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::base {

/// How float values become 8-bit ones.
enum class Encoding {
    linear, ///< value * 255: visibility, masks, heat maps already in display colours
    srgb,   ///< linear radiance through the sRGB transfer function (IEC 61966-2-1)
};

/// Writes 1, 3 or 4 channels as an 8-bit PNG; values are clamped to [0, 1]; NaN becomes 0. Whole or not at all. Throws Error.
void write_png(const std::filesystem::path&, const Picture&, Encoding);

/// Reads a PNG or JPEG as floats in [0, 1], in the file's own encoding converted by `encoding` to linear. Throws Error.
Picture read_png(const std::filesystem::path&, Encoding);

/// Named channels of an EXR file, 32-bit float. `names` has one entry a channel ("R", "G", "B", "Y", "variance" ...).
void write_exr(const std::filesystem::path&, const Picture&, const std::vector<std::string>& names);
Picture read_exr(const std::filesystem::path&, std::vector<std::string>* names = nullptr);

} // namespace gnomon::base
