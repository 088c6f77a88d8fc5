// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <future>
#include <pybind11/pybind11.h>
#include <stop_token>

namespace gnomon::python {

/// Runs work(std::stop_token) without the interpreter's lock, on a thread of its own, so that this one can ask Python for signals:
/// Ctrl-C stops the work and is thrown on once it has ended. What the work throws is thrown here.
template <class Work> auto wait_for(Work work)
{
    std::stop_source stop;
    auto result = std::async(std::launch::async, [&work, token = stop.get_token()] { return work(token); });
    for (;;) {
        bool ended = false;
        {
            const pybind11::gil_scoped_release unlocked;
            ended = result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
        }
        if (ended) return result.get();
        if (PyErr_CheckSignals() == 0) continue;
        const pybind11::error_already_set interrupted;
        stop.request_stop();
        {
            const pybind11::gil_scoped_release unlocked;
            result.wait();
        }
        throw interrupted;
    }
}

} // namespace gnomon::python
