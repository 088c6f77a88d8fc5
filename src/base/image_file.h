// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::base {

/// How float values become 8-bit ones.
enum class Encoding {
    linear, ///< value * 255: visibility, masks, heat maps already in display colours
    srgb, ///< linear radiance through the sRGB transfer function (IEC 61966-2-1)
};

/// The longest side of a picture that is read or written; it bounds the memory that a hostile header can ask for.
inline constexpr int longest_side = 16384;

/// Writes 1, 3 or 4 channels as an 8-bit PNG; values are clamped to [0, 1]; NaN becomes 0. Whole or not at all. Throws Error.
void write_png(const std::filesystem::path&, const Picture&, Encoding);

/// Reads a PNG or JPEG as floats in [0, 1], in the file's own encoding converted by `encoding` to linear. Throws Error.
/// 1, 3 or 4 channels (grey with alpha becomes 4); alpha is never converted; 16-bit PNG keeps its precision.
Picture read_png(const std::filesystem::path&, Encoding);

/// An 8-bit RGBA picture as it is stored, row 0 on top.
struct Pixels8 {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};
/// Decodes a PNG or JPEG in memory. `name` is for the error. Throws Error.
Pixels8 decode_rgba8(std::span<const std::byte>, std::string_view name);

/// Named channels of an EXR file, 32-bit float. `names` has one entry a channel ("R", "G", "B", "Y", "variance" ...).
/// EXR stores channels by name in alphabetical order; reading gives R, G, B, A first and then the rest alphabetically.
void write_exr(const std::filesystem::path&, const Picture&, const std::vector<std::string>& names);
Picture read_exr(const std::filesystem::path&, std::vector<std::string>* names = nullptr);

} // namespace gnomon::base
