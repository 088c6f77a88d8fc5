// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "lab/tune.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace {

/// Every scene with every camera and light, a place each.
std::vector<lab::StageOptions> places(const Tune& options, const std::vector<std::string>& scenes)
{
    std::vector<lab::StageOptions> out;
    for (const std::string& scene : scenes) {
        Picture picture;
        picture.scene = scene, picture.size = options.size;
        for (const std::string& camera : options.cameras.empty() ? std::vector<std::string>{""} : options.cameras)
            for (const std::string& light : options.lights.empty() ? std::vector<std::string>{""} : options.lights) {
                picture.camera = camera;
                if (!light.empty()) picture.lights = {light};
                out.push_back(stage_options(picture));
            }
    }
    return out;
}

} // namespace

int tune(const Tune& options)
{
    const auto device = open_device(options.common);
    const lab::Tuned tuned = lab::tune(*device,
        {.technique = options.technique,
            .vary = options.vary,
            .tuning = places(options, options.scenes),
            .validation = places(options, options.validation),
            .minimise = options.minimise,
            .under = options.under,
            .reference = options.reference,
            .budget = options.budget,
            .seed = uint64_t(options.seed),
            .truth_samples = options.truth_samples,
            .preset = options.output});
    demand_valid(*device);
    if (options.common.json) {
        fmt::print("{}\n", lab::preset_json(tuned.preset).dump(1));
        return tuned.written ? 0 : 1;
    }
    fmt::print("{}{} runs were made now, {} kept from before{}\n", lab::tune_text(tuned), tuned.measured, tuned.kept,
        tuned.written ? "; use it as @" + options.output : "");
    return tuned.written ? 0 : 1;
}

} // namespace gnomon::cli
