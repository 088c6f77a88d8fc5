// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <gnomon/gnomon.h>

#include <functional>
#include <string>

namespace gnomon::host {

/// An error whose kind the host is to know; every other exception becomes the kind that its type tells.
struct Refusal : base::Error {
    Refusal(gnomon_result r, const std::string& text)
        : base::Error(text)
        , result(r)
    {
    }
    gnomon_result result;
};

template <class... Args> [[noreturn]] void refuse(gnomon_result result, fmt::format_string<Args...> text, Args&&... args)
{
    throw Refusal(result, fmt::format(text, std::forward<Args>(args)...));
}

/// Runs `work` for a function of gnomon.h: no exception leaves, and the sentence is kept for gnomon_error_message.
gnomon_result guarded(const std::function<void()>& work) noexcept;

const char* last_message() noexcept;

} // namespace gnomon::host
