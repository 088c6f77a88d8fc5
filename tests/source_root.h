// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>

namespace gnomon::tests {

/// The source tree that a test reads (goldens, scene.json, includes): $GNOMON_ROOT where a bundle of tests runs elsewhere, else
/// the tree that was built.
inline std::filesystem::path source_root()
{
    const char* moved = std::getenv("GNOMON_ROOT");
    return moved ? moved : GNOMON_SOURCE;
}

} // namespace gnomon::tests
