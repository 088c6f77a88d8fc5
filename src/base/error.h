// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace gnomon::base {

/// What the world did wrong (missing file, unknown name, device without a feature). The message is one sentence that names
/// the thing, the place and the next step; it is printed as it stands, after "gnomon: ". Programmer errors are asserts instead.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws Error with a formatted sentence.
template <class... Args> [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args)
{
    throw Error(fmt::format(text, std::forward<Args>(args)...));
}

} // namespace gnomon::base
