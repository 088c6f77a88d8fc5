// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

// Options that several commands take, and those of commands that draw one technique.
namespace gnomon::cli {

void add_common(CLI::App&, Common&, bool device = true);
void add_picture(CLI::App&, Picture&, bool camera = true);
void add_look(CLI::App&, float& exposure, float& ambient);
void add_slice(CLI::App&, Slice&);
void add_export(CLI::App&, Export&);
void add_view(CLI::App&, View&);

/// `--<technique>.<parameter> value` and `--<technique>.<parameter>=value` for the technique that runs, as parameter=value.
std::vector<std::string> technique_options(const CLI::App&, const std::string& choice);

} // namespace gnomon::cli
