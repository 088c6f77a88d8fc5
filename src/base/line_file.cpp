// SPDX-License-Identifier: Apache-2.0
#include "base/line_file.h"

#include "base/error.h"
#include "base/file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace gnomon::base {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t limit = uint64_t(1) << 30; // results of a million runs

std::string cause(int error) { return std::generic_category().message(error); }

} // namespace

std::vector<std::string> read_lines(const fs::path& path)
{
    const std::string text = read_text(path, limit);
    std::vector<std::string> lines;
    for (size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) lines.push_back(text.substr(at, end - at));
    return lines;
}

LineFile::LineFile(fs::path path)
    : path_(std::move(path))
{
    std::error_code error;
    if (path_.has_parent_path()) fs::create_directories(path_.parent_path(), error);
    if (error) fail("cannot make the folder '{}': {}", path_.parent_path().string(), error.message());
    if (fs::exists(path_, error) && !fs::is_regular_file(path_, error)) fail("cannot write '{}': it is no plain file", path_.string());
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0) fail("cannot write '{}': {}; choose a folder that can be written", path_.string(), cause(errno));
    try {
        if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
            fail("'{}' is being written by another process; wait for it, or choose another folder", path_.string());
        lines_ = read_lines(path_);
        for (const std::string& line : lines_) size_ += line.size() + 1;
        if (::ftruncate(file_, off_t(size_)) != 0) fail("cannot write '{}': {}", path_.string(), cause(errno));
    } catch (...) {
        ::close(file_);
        throw;
    }
}

LineFile::~LineFile() { ::close(file_); }

void LineFile::append(std::string_view line)
{
    const std::string text = std::string(line) + "\n";
    int error = 0;
    for (size_t done = 0; done < text.size() && !error;) {
        const ssize_t n = ::write(file_, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0)
            error = errno;
        else
            done += size_t(n);
    }
    if (!error && ::fsync(file_) != 0 && errno != EINVAL) error = errno;
    if (!error) {
        size_ += text.size();
        return;
    }
    const bool cut = ::ftruncate(file_, off_t(size_)) == 0;
    fail("cannot write '{}': {}; the lines before are {}", path_.string(), cause(error), cut ? "whole" : "there");
}

} // namespace gnomon::base
