// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

namespace gnomon::base {

namespace {

using namespace std::chrono_literals;

constexpr auto quiet = 1s; // work shorter than this shows nothing

bool forced()
{
    const char* value = std::getenv("GNOMON_PROGRESS");
    return value && *value && std::string_view(value) != "0";
}

} // namespace

Progress::Progress(std::string what, uint64_t total)
    : what_(std::move(what))
    , total_(std::max<uint64_t>(total, 1))
    , begin_(std::chrono::steady_clock::now())
    , drawn_(begin_)
{
    terminal_ = ::isatty(STDERR_FILENO) == 1;
    visible_ = terminal_ || forced();
}

Progress::~Progress()
{
    const std::lock_guard lock(mutex_);
    if (drawn_ != begin_) draw(true);
}

void Progress::advance(uint64_t steps)
{
    const std::lock_guard lock(mutex_);
    done_ += steps;
    if (!visible_) return;
    const auto now = std::chrono::steady_clock::now();
    const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
    if (now - begin_ < quiet || (drawn_ != begin_ && now - drawn_ < interval)) return;
    drawn_ = now;
    draw(false);
}

void Progress::draw(bool last)
{
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const double part = std::min(1.0, double(done_) / double(total_));
    std::string line = fmt::format("{}: {:.0f} %, {:.1f} s", what_, 100.0 * part, seconds);
    if (!last && part > 0) line += fmt::format(", {:.1f} s left", seconds / part * (1.0 - part));
    // A terminal's line is drawn over itself; ESC [K clears what a longer line before left behind.
    if (terminal_)
        fmt::print(stderr, "\r{}\x1b[K{}", line, last ? "\n" : "");
    else
        fmt::print(stderr, "{}\n", line);
    std::fflush(stderr);
}

} // namespace gnomon::base
