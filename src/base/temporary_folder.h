// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace gnomon::base {

/// An empty folder of its own, which is gone with all that it holds when this is, or when the process has ended, however it did.
class TemporaryFolder {
public:
    TemporaryFolder(); ///< Throws base::Error where none can be made.
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    int guard_ = -1, pipe_ = -1; ///< a child, and the end of a pipe whose other end it watches
};

} // namespace gnomon::base
