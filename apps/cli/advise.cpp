// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/advise.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon::cli {

namespace {

lab::AdviseOptions advise_options(const Advise& options, const std::string& scene)
{
    Picture picture = options.picture;
    picture.scene = scene;
    return {.stage = stage_options(picture),
        .budget = options.budget,
        .prefer = lab::parse_prefer(options.prefer),
        .metric = options.metric,
        .reference = options.reference,
        .without = options.without,
        .exhaustive = options.exhaustive,
        .truth_samples = options.truth_samples,
        .repeats = options.repeats};
}

} // namespace

int advise(const Advise& options)
{
    if (!options.output.empty() && std::filesystem::path(options.output).extension() != ".md")
        base::fail("'{}' is no .md file; the table is written as Markdown", options.output);
    const auto device = open_device(options.common);
    std::vector<lab::Advice> all;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const std::string& scene : options.scenes) {
        all.push_back(lab::advise(*device, advise_options(options, scene)));
        if (options.common.json)
            json.push_back(lab::advice_json(all.back()));
        else
            fmt::print("{}", lab::advice_text(all.back()));
        // after each scene, since the next one may take an hour; where nothing was found yet, there is nothing to write
        const bool found = std::any_of(all.begin(), all.end(), [](const lab::Advice& a) { return a.chosen.has_value(); });
        if (found && !options.output.empty()) base::write_text(options.output, lab::advice_page(all));
    }
    demand_valid(*device);
    if (options.common.json) fmt::print("{}\n", (json.size() == 1 ? json[0] : json).dump(1));
    int code = 0;
    for (const lab::Advice& a : all)
        if (!a.chosen) fmt::print(stderr, "gnomon: {}: {}\n", a.scene, a.nothing), code = 1;
    return code;
}

} // namespace gnomon::cli
