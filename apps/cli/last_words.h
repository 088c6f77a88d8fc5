// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::cli {

inline constexpr const char* out_of_memory = "gnomon: out of memory; try a smaller --size, --detail or scene\n";

/// Ends the program with that sentence and code 1 where memory runs out and nothing may be thrown, and with another where any other
/// exception cannot be caught. The first thing in main.
void set_last_words();

} // namespace gnomon::cli
