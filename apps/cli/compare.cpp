// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "base/image_file.h"
#include "lab/compare.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace fs = std::filesystem;

int compare(const Compare& options)
{
    const auto device = open_device(options.common);
    const fs::path folder = options.output.empty() ? fs::path("out") / ("compare-" + fs::path(options.picture.scene).stem().string())
                                                   : fs::path(options.output);
    const lab::Comparison comparison = lab::compare(*device,
        {.stage = stage_options(options.picture),
            .techniques = options.techniques,
            .reference = options.reference,
            .truth_samples = options.truth_samples,
            .repeats = options.repeats,
            .motion = options.motion,
            .folder = folder});
    demand_valid(*device);
    if (options.common.json) {
        fmt::print("{}\n", lab::results_json(comparison).dump(1));
        return 0;
    }
    fmt::print("{}, {}\n{}", comparison.device, comparison.driver, lab::results_table(comparison));
    fmt::print(
        "open {} for pictures beside the truth; results.json and results.csv are in the same folder\n", (folder / "index.html").string());
    return 0;
}

int truth(const Truth& options)
{
    const lab::Stage stage = lab::open_stage(stage_options(options.picture));
    for (const std::string& warning : stage.scene.warnings) fmt::print(stderr, "gnomon: warning: {}\n", warning);
    fs::path file = options.output.empty() ? fs::path("out") / (fs::path(options.picture.scene).stem().string() + ".truth.exr")
                                           : fs::path(options.output);
    if (file.extension() != ".exr")
        base::fail("'{}' is not an .exr file; the truth is written as EXR, with a PNG beside it", file.string());
    nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}, {"lights", nlohmann::ordered_json::array()}};
    for (size_t i = 0; i < stage.lights.size(); ++i) {
        const truth::Reference reference = truth::reference(stage.scene, stage.view, stage.lights[i], {.samples = options.samples},
            options.transmittance ? truth::Quantity::transmittance : truth::Quantity::visibility);
        const base::Picture &mean = reference.visibility.mean, &variance = reference.visibility.variance;
        base::Picture both(mean.size, 2 * mean.channels);
        for (size_t p = 0; p < mean.size.area(); ++p)
            for (size_t c = 0; c < size_t(mean.channels); ++c) {
                both.values[p * size_t(both.channels) + c] = mean.values[p * size_t(mean.channels) + c];
                both.values[p * size_t(both.channels) + size_t(mean.channels) + c] = variance.values[p * size_t(mean.channels) + c];
            }
        fs::path target = file;
        if (i > 0) target.replace_extension(fmt::format("{}.exr", i + 1));
        base::write_exr(target, both,
            mean.channels == 1 ? std::vector<std::string>{"visibility", "variance"}
                               : std::vector<std::string>{"R", "G", "B", "variance.R", "variance.G", "variance.B"});
        fs::path shown = target;
        shown.replace_extension(".png");
        base::write_png(shown, mean, base::Encoding::linear);
        json["files"].push_back(target.string());
        json["files"].push_back(shown.string());
        json["lights"].push_back({{"name", stage.lights[i].name}, {"kind", scene::kind_name(stage.lights[i].kind())},
            {"samples", reference.visibility.samples}, {"ms", reference.trace_ms}, {"cached", reference.from_cache}});
    }
    if (options.common.json)
        fmt::print("{}\n", json.dump(1));
    else
        for (const auto& f : json["files"]) fmt::print("{}\n", f.get<std::string>());
    return 0;
}

} // namespace gnomon::cli
