// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace gnomon::base {

/// A progress line on standard error for work over a second. Silent where standard error is no terminal, until `--progress`
/// forces it. Thread-safe.
class Progress {
public:
    Progress(std::string what, uint64_t total);
    ~Progress();
    void advance(uint64_t steps = 1);

private:
    void draw(bool last);
    std::mutex mutex_;
    std::string what_;
    uint64_t total_, done_ = 0;
    std::chrono::steady_clock::time_point begin_, drawn_;
    bool visible_ = false, terminal_ = false;
};

} // namespace gnomon::base
