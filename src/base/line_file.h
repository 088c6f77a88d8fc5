// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::base {

/// A text file that grows by whole lines, so that a process may be killed at any moment and loses at most the line in hand: each is
/// written at once and synced, and what a killed process left after the last line's end is cut off at the next opening.
class LineFile {
public:
    /// Makes the file and its folder where they are missing. Throws Error where another process holds it open, or it is no plain file.
    explicit LineFile(std::filesystem::path);
    ~LineFile();
    LineFile(const LineFile&) = delete;
    LineFile& operator=(const LineFile&) = delete;

    const std::vector<std::string>& lines() const { return lines_; } ///< as they were at the opening
    /// `line` holds no line's end. Where it cannot be written whole (a full disk), the file stays as it was. Throws Error.
    void append(std::string_view line);

private:
    std::filesystem::path path_;
    int file_ = -1;
    uint64_t size_ = 0;
    std::vector<std::string> lines_;
};

/// The whole lines of a file; what follows the last line's end is left out. Throws Error.
std::vector<std::string> read_lines(const std::filesystem::path&);

} // namespace gnomon::base
