// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::base {

// What must not be shown to stb_image, as the end of a sentence "it ..."; empty where nothing is wrong.

/// The version of 2022 writes beyond its tables where a JPEG has more than 256 Huffman codes, also where it is only asked for the size. It
/// makes room for a chunk of a PNG before it looks whether the chunk is there.
std::string unfit_form(std::span<const std::byte> file);
/// It takes memory and time for whatever size a header of a few bytes states, PNG or JPEG.
std::string unfit_size(std::span<const std::byte> file, uint64_t pixels);

} // namespace gnomon::base
