// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::lab {

/// A technique with parameters that were found by `tune`, as a file (docs/tune-and-advise.md). Wherever a technique is named, "@file" takes
/// it.
struct Preset {
    struct Place {
        std::string scene, camera, light;
        base::Size size;
        double before = 0, after = 0; ///< of what was minimised
        double time_ratio = 0; ///< after by before; 0 where times were not asked for
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
double mean_before(const std::vector<Preset::Place>&);
double mean_after(const std::vector<Preset::Place>&);

nlohmann::ordered_json preset_json(const Preset&);
/// Written whole or not at all. Throws base::Error.
void write_preset(const std::filesystem::path&, const Preset&);
/// What parse_choice needs of one: the technique and its parameters. Throws base::Error naming the file.
Choice read_preset_choice(const std::filesystem::path&);

} // namespace gnomon::lab
