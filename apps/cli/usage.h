// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace gnomon::cli {

/// A command line that was not understood.
class UsageError : public base::Error {
public:
    using base::Error::Error;
};

/// Throws UsageError about the first of `words`, which no option of `app` took; `hint` follows where it is an unknown option.
[[noreturn]] void refuse_words(const CLI::App& app, const std::vector<std::string>& words, const std::string& hint = "");

/// Throws UsageError with what CLI11 found, as one sentence.
[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError&);

} // namespace gnomon::cli
