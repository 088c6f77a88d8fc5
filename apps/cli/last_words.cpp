// SPDX-License-Identifier: Apache-2.0
#include "last_words.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace gnomon::cli {

namespace {

std::atomic<bool> memory_ran_out = false;

/// In place of operator new's own throw.
[[noreturn]] void at_failed_new()
{
    memory_ran_out = true;
    throw std::bad_alloc();
}

/// JSON's destructors and the standard library's directory iterators ask for memory where nothing may be thrown; which exception it was
/// cannot always be found here.
[[noreturn]] void at_terminate()
{
    if (memory_ran_out) {
        std::fputs(out_of_memory, stderr);
        std::_Exit(1);
    }
    std::fputs("gnomon: internal fault in a place that cannot report it; please report it with the command line\n", stderr);
    std::abort();
}

} // namespace

void set_last_words()
{
    std::set_new_handler(at_failed_new);
    std::set_terminate(at_terminate);
}

} // namespace gnomon::cli
