// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::base {

/// The whole file. Throws Error naming the file and the cause; a file above `limit` bytes is refused.
std::vector<std::byte> read_file(const std::filesystem::path&, uint64_t limit = uint64_t(16) << 30);
std::string read_text(const std::filesystem::path&, uint64_t limit = uint64_t(64) << 20);

/// Writes beside the target and renames, so that a reader or a crash never sees half a file. Makes missing folders. Throws Error.
void write_file(const std::filesystem::path&, std::span<const std::byte>);
void write_text(const std::filesystem::path&, std::string_view);

/// The folder for caches: $GNOMON_CACHE, else $XDG_CACHE_HOME/gnomon, else ~/.cache/gnomon, else the temporary folder.
std::filesystem::path cache_folder();

} // namespace gnomon::base
