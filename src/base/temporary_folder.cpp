// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_folder.h"

#include "base/error.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::base {

namespace fs = std::filesystem;

namespace {

/// In a child, only calls that are safe after a fork: waits until the other end of the pipe closes, however its process ended.
[[noreturn]] void wait_and_remove(const int (&ends)[2], const char* folder)
{
    ::setsid(); // a keyboard's interrupt is not meant for this
    ::close(ends[1]);
    char none;
    while (::read(ends[0], &none, 1) < 0 && errno == EINTR) { }
    ::execl("/bin/rm", "rm", "-rf", "--", folder, static_cast<char*>(nullptr));
    ::_exit(1);
}

} // namespace

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (fs::temp_directory_path() / "gnomon-XXXXXX").string(); // mkdtemp fills in the six letters
    if (!::mkdtemp(pattern.data()))
        fail("cannot make a folder in {}; set TMPDIR to one that can be written", fs::temp_directory_path().string());
    path_ = pattern;
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    guard_ = ::fork();
    if (guard_ == 0) wait_and_remove(ends, pattern.c_str());
    ::close(ends[0]);
    pipe_ = ends[1];
}

TemporaryFolder::~TemporaryFolder()
{
    if (pipe_ >= 0) ::close(pipe_);
    if (guard_ > 0) ::waitpid(guard_, nullptr, 0);
    std::error_code ignored;
    fs::remove_all(path_, ignored); // where there was no guard
}

} // namespace gnomon::base
