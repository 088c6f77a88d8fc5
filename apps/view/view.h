// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/stage.h"

#include <filesystem>
#include <string>
#include <vector>

// `gnomon view`: a window on one scene, with every technique and its parameters, beside the truth or another technique.
namespace gnomon::view {

struct Options {
    lab::StageOptions stage; ///< its size is that of the picture at first
    std::string technique = "shadow_map"; ///< lab::parse_choice
    std::vector<std::string> parameters; ///< name=value
    std::string against; ///< "", "truth", or lab::parse_choice
    std::string device; ///< part of a device's name
    bool validation = false;
    float exposure = 0, ambient = 0.45f; ///< stops; relative
    std::filesystem::path state; ///< where given, a JSON file that says what the window shows and where its widgets lie
    double measure = 0; ///< > 0: goes around the target in so many seconds, prints pictures a second, and ends
    bool json = false; ///< prints them as JSON
};

/// Opens the window and returns the exit code once it has been closed. Throws base::Error where there is no display.
int run(const Options&);

} // namespace gnomon::view
