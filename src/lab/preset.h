// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gnomon::lab {

/// A technique with parameters that were found by `tune`, as a file (docs/tune-and-advise.md). Wherever a technique is named, "@file" takes
/// it.
struct Preset {
    struct Place {
        std::string scene, camera, light;
        base::Size size;
        std::map<std::string, double> before, after; ///< of each quantity that was minimised
        std::vector<double> ratios; ///< after by before, of each term of what was minimised
        double time_ratio = 0; ///< after by before; 0 where times were not asked for
        double ratio() const; ///< mean of `ratios`: what the search made small
    };
    Choice choice;
    std::vector<std::string> vary; ///< the parameters that were searched
    std::string minimise;
    std::vector<std::string> under;
    std::string reference; ///< of filter metrics
    std::vector<Place> tuning, validation;
    size_t evaluations = 0;
    uint64_t seed = 0;
    std::string device, driver, commit;
};
/// What a setting errs as parts of what the search's start does.
struct Ratios {
    double mean = 1, error = 0; ///< over the places, and its standard error
    std::vector<double> terms; ///< of each, the mean over the places
    /// Smaller than 1 by more than the standard error and half a percent, and no term larger than it was by more than a percent.
    bool gained() const;
};
Ratios ratios(const std::vector<Preset::Place>&);

nlohmann::ordered_json preset_json(const Preset&);
/// Written whole or not at all. Throws base::Error.
void write_preset(const std::filesystem::path&, const Preset&);
/// What parse_choice needs of one: the technique and its parameters. Throws base::Error naming the file.
Choice read_preset_choice(const std::filesystem::path&);

} // namespace gnomon::lab
