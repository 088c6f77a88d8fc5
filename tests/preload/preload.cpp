// SPDX-License-Identifier: Apache-2.0
// Memory, disk and clock as they are on a bad day. The tests load this before the program (LD_PRELOAD), whose own code knows nothing of it:
//   GNOMON_FAIL_NEW=n      the n-th request for memory after the beginning of main fails
//   GNOMON_FAIL_WRITE=n    from the n-th write to a file on, the disk is full
//   GNOMON_READ_ONLY=1     no file or folder can be made, named, or opened to be written
//   GNOMON_CLOCK=1         the clocks jump: wall time an hour to and fro, the steady clock an hour ahead, once
//   GNOMON_COUNT=file      two numbers, at the end: requests and writes
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <new>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

std::atomic<bool> running = false;
std::atomic<long> requests = 0, writes = 0, looks = 0;

long number(const char* name)
{
    const char* text = std::getenv(name);
    return text ? std::atol(text) : -1;
}

/// The program's own requests, and those that the standard library makes for it; drivers and compilers behind them end on a failed one.
bool look_whose(const void* caller)
{
    Dl_info info{};
    if (!::dladdr(caller, &info) || !info.dli_fname) return false;
    const char* slash = std::strrchr(info.dli_fname, '/');
    const char* name = slash ? slash + 1 : info.dli_fname;
    return !std::strcmp(name, "gnomon") || !std::strncmp(name, "libstdc++", 9);
}

/// Looked up once for each caller: a compiler in a driver asks for memory millions of times.
bool ours(const void* caller)
{
    struct Known {
        const void* caller;
        bool ours;
    };
    thread_local Known known[4096] = {};
    Known& k = known[reinterpret_cast<std::uintptr_t>(caller) / 4 % 4096];
    if (k.caller != caller) k = {caller, look_whose(caller)};
    return k.ours;
}

void* request(std::size_t bytes, std::size_t alignment, const void* caller)
{
    static const long failing = number("GNOMON_FAIL_NEW");
    if (running.load(std::memory_order_relaxed) && ours(caller) && requests++ == failing) return nullptr;
    if (bytes == 0) bytes = 1;
    return alignment ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment) : std::malloc(bytes);
}

void* request_or_throw(std::size_t bytes, std::size_t alignment, const void* caller)
{
    if (void* p = request(bytes, alignment, caller)) return p;
    if (const std::new_handler handler = std::get_new_handler()) handler(); // as the standard's operator new; the program's throws
    throw std::bad_alloc();
}

void* request_or_null(std::size_t bytes, std::size_t alignment, const void* caller) noexcept
{
    try {
        return request_or_throw(bytes, alignment, caller);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

bool read_only()
{
    static const bool yes = number("GNOMON_READ_ONLY") > 0;
    return yes && running;
}

using Main = int(int, char**, char**);
Main* program = nullptr;

int begin(int argc, char** argv, char** environment)
{
    running = true;
    const int code = program(argc, argv, environment);
    running = false;
    if (const char* file = std::getenv("GNOMON_COUNT"))
        if (FILE* out = std::fopen(file, "w")) {
            std::fprintf(out, "%ld %ld\n", requests.load(), writes.load());
            std::fclose(out);
        }
    return code;
}

} // namespace

void* operator new(std::size_t n) { return request_or_throw(n, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t n) { return request_or_throw(n, 0, __builtin_return_address(0)); }
void* operator new(std::size_t n, std::align_val_t a) { return request_or_throw(n, std::size_t(a), __builtin_return_address(0)); }
void* operator new[](std::size_t n, std::align_val_t a) { return request_or_throw(n, std::size_t(a), __builtin_return_address(0)); }
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return request_or_null(n, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept { return request_or_null(n, 0, __builtin_return_address(0)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

extern "C" {

/// What comes before main (constructors of libraries) is no part of the program's run.
int __libc_start_main(Main* main, int argc, char** argv, void (*init)(), void (*fini)(), void (*rtld_fini)(), void* stack_end)
{
    using Start = int(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*);
    auto* real = reinterpret_cast<Start*>(::dlsym(RTLD_NEXT, "__libc_start_main"));
    program = main;
    return real(begin, argc, argv, init, fini, rtld_fini, stack_end);
}

ssize_t write(int file, const void* data, size_t bytes)
{
    static const long failing = number("GNOMON_FAIL_WRITE");
    struct stat status { };
    if (running && file > 2 && ours(__builtin_return_address(0)) && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode)
        && writes++ >= failing && failing >= 0) {
        errno = ENOSPC;
        return -1;
    }
    return ::syscall(SYS_write, file, data, bytes);
}

int open(const char* name, int flags, ...)
{
    va_list more;
    va_start(more, flags);
    const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0;
    va_end(more);
    if (read_only() && (flags & O_ACCMODE) != O_RDONLY && ours(__builtin_return_address(0))) {
        errno = EROFS;
        return -1;
    }
    return int(::syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}

int mkdir(const char* name, mode_t mode)
{
    struct stat status { };
    if (read_only() && ours(__builtin_return_address(0))) {
        errno = ::stat(name, &status) == 0 ? EEXIST : EROFS; // as a real one says
        return -1;
    }
    return int(::syscall(SYS_mkdir, name, mode));
}

int clock_gettime(clockid_t clock, struct timespec* time)
{
    static const bool jumping = number("GNOMON_CLOCK") > 0;
    const int result = int(::syscall(SYS_clock_gettime, clock, time));
    if (!jumping || !running || result != 0) return result;
    const long look = looks++;
    if (clock == CLOCK_REALTIME) time->tv_sec += look % 2 ? 3600 : -3600;
    if (clock == CLOCK_MONOTONIC && look > 20) time->tv_sec += 3600;
    return result;
}

} // extern "C"
