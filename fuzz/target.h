// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "base/temporary_folder.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>

// What every target needs. A target hands its input to a reader; the only outcomes allowed are success and a base::Error with a sentence.
// Any other exception leaves LLVMFuzzerTestOneInput, and libFuzzer reports it with the input that caused it.
namespace gnomon::fuzz {

/// Ends the program with a report where something does not hold that the rest of Gnomon relies on.
inline void demand(bool holds, std::string_view what)
{
    if (holds) return;
    std::fprintf(stderr, "not as it must be: %.*s\n", int(what.size()), what.data());
    __builtin_trap();
}

/// Whether `read` came to its end.
template <class Read> bool accepts(Read read)
{
    try {
        read();
        return true;
    } catch (const base::Error& e) {
        demand(*e.what() != '\0', "an error says what is wrong");
        return false;
    }
}

/// A folder for the inputs of readers that take files.
inline const std::filesystem::path& folder()
{
    static const base::TemporaryFolder own;
    return own.path();
}

inline std::filesystem::path write(const char* name, std::string_view bytes)
{
    const std::filesystem::path file = folder() / name;
    std::ofstream(file, std::ios::binary) << bytes; // base::write_file syncs to the disk, a thousand times slower
    return file;
}

inline std::string_view text_of(const uint8_t* data, size_t size) { return {reinterpret_cast<const char*>(data), size}; }

} // namespace gnomon::fuzz
