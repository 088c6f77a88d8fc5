// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include "base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace gnomon::base {

namespace fs = std::filesystem;

namespace {

std::string cause(int error) { return std::generic_category().message(error); }

class Descriptor {
public:
    explicit Descriptor(int fd)
        : fd_(fd)
    {
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor()
    {
        if (fd_ >= 0) ::close(fd_);
    }
    int get() const { return fd_; }
    /// 0 or the error: a network file system may report a full disk only here.
    int close()
    {
        const int result = ::close(fd_) == 0 ? 0 : errno;
        fd_ = -1;
        return result;
    }

private:
    int fd_;
};

/// 0 or the error.
int write_all(int fd, std::span<const std::byte> data)
{
    constexpr size_t chunk = size_t(1) << 30; // Linux writes at most 2 GiB a call
    while (!data.empty()) {
        const ssize_t n = ::write(fd, data.data(), std::min(data.size(), chunk));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return errno;
        data = data.subspan(size_t(n));
    }
    return 0;
}

/// A new file beside the target. Its own short name, because a suffix could push a long name over the system's limit; mode 0666
/// less the umask, which mkstemp would not give.
int open_temporary(const fs::path& folder, fs::path& name)
{
    for (int attempt = 0;; ++attempt) {
        name = folder / fmt::format(".gnomon-{}-{}.tmp", ::getpid(), attempt);
        const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST || attempt == 9999) return fd;
    }
}

/// A file without a name, which is gone with the process however that ends. -1 where the file system has none.
int open_unnamed(const fs::path& folder)
{
    if (::access("/proc/self/fd", X_OK) != 0) return -1; // by which it is named
    return ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
}

/// 0 or the error.
int give_name(int fd, const fs::path& folder, fs::path& name)
{
    const std::string self = fmt::format("/proc/self/fd/{}", fd);
    for (int attempt = 0;; ++attempt) {
        name = folder / fmt::format(".gnomon-{}-{}.tmp", ::getpid(), attempt);
        if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return 0;
        if (errno != EEXIST || attempt == 9999) return errno;
    }
}

void write_directly(const fs::path& path, std::span<const std::byte> data)
{
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    const int error = file.get() < 0 ? errno : write_all(file.get(), data);
    if (error) fail("cannot write to '{}': {}", path.string(), cause(error));
}

} // namespace

std::vector<std::byte> read_file(const fs::path& path, uint64_t limit)
{
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status { };
    if (file.get() < 0 || ::fstat(file.get(), &status) != 0) fail("cannot read '{}': {}", path.string(), cause(errno));
    if (S_ISDIR(status.st_mode)) fail("cannot read '{}': it is a folder; name a file in it", path.string());
    const auto refuse = [&] { fail("cannot read '{}': it is larger than the limit of {} bytes for such files", path.string(), limit); };
    if (status.st_size > 0 && uint64_t(status.st_size) > limit) refuse();

    // The size is a hint only: pipes have none, and a file may grow meanwhile.
    std::vector<std::byte> data(size_t(status.st_size) + 1);
    size_t used = 0;
    for (;;) {
        if (used == data.size()) data.resize(data.size() * 2 + 65536);
        const ssize_t n = ::read(file.get(), data.data() + used, std::min(data.size() - used, size_t(1) << 30));
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail("cannot read '{}': {}", path.string(), cause(errno));
        if (n == 0) break;
        used += size_t(n);
        if (used > limit) refuse();
    }
    data.resize(used);
    return data;
}

std::string read_text(const fs::path& path, uint64_t limit)
{
    const std::vector<std::byte> data = read_file(path, limit);
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

void write_file(const fs::path& path, std::span<const std::byte> data)
{
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail("cannot write '{}': it is a folder; name a file in it", path.string());
    // Renaming over /dev/null or a pipe would replace it.
    if (fs::exists(status) && !fs::is_regular_file(status)) return write_directly(path, data);
    const fs::path target = fs::is_symlink(fs::symlink_status(path, error)) ? fs::weakly_canonical(path, error) : path;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    fs::create_directories(folder, error);
    if (error) fail("cannot make the folder '{}': {}", folder.string(), error.message());

    fs::path temporary;
    const int unnamed = open_unnamed(folder);
    Descriptor file(unnamed >= 0 ? unnamed : open_temporary(folder, temporary));
    if (file.get() < 0) fail("cannot write '{}': {}; choose a folder that can be written", path.string(), cause(errno));
    int result = write_all(file.get(), data);
    // Without fsync a crash after the rename can leave an empty file under the final name (ext4 delayed allocation).
    if (!result && ::fsync(file.get()) != 0 && errno != EINVAL) result = errno;
    if (!result && unnamed >= 0) result = give_name(unnamed, folder, temporary);
    const int closed = file.close();
    if (!result) result = closed;
    if (!result && ::rename(temporary.c_str(), target.c_str()) != 0) result = errno;
    if (result) {
        if (!temporary.empty()) ::unlink(temporary.c_str());
        fail("cannot write '{}': {}", path.string(), cause(result));
    }
}

void write_text(const fs::path& path, std::string_view text) { write_file(path, std::as_bytes(std::span(text))); }

fs::path cache_folder()
{
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::string(value ? value : "");
    };
    if (const std::string own = variable("GNOMON_CACHE"); !own.empty()) return own;
    if (const std::string xdg = variable("XDG_CACHE_HOME"); !xdg.empty()) return fs::path(xdg) / "gnomon";
    if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "gnomon";
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    return (error ? fs::path("/tmp") : temporary) / "gnomon";
}

} // namespace gnomon::base
