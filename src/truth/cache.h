// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "truth/truth.h"

#include <optional>
#include <string>

namespace gnomon::truth {

/// Where truth is kept between runs is one file an entry, so that entries can be removed one by one.
std::string cache_key(const scene::Scene&, const scene::View&, const scene::Light&, const Settings&, Quantity);

/// Empty where there is no whole, undamaged entry for a picture of this size. Marks a found one as used.
std::optional<Reference> load(const std::filesystem::path& folder, const std::string& key, base::Size, int channels);
void store(const std::filesystem::path& folder, const std::string& key, const Reference&);

/// Deletes the entries that were not used for longest until the folder holds at most `limit` bytes of them.
void prune(const std::filesystem::path& folder, uint64_t limit);

inline constexpr uint64_t cache_limit = uint64_t(2) << 30;

} // namespace gnomon::truth
