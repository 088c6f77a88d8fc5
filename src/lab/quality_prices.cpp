// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/line_file.h"
#include "lab/quality.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The label of the light of experiments/quality that an entry is measured under; of the baseline, and of lights without area.
constexpr std::string_view with_area = "area", without_area = "hard";

std::vector<Json> read_results(const fs::path& root, const std::string& experiment)
{
    std::vector<Json> out;
    std::error_code none;
    for (const fs::directory_entry& device : fs::directory_iterator(root / "experiments" / "results", none)) {
        const fs::path file = device.path() / experiment / "results.jsonl";
        if (!fs::exists(file)) continue;
        for (const std::string& line : base::read_lines(file)) out.push_back(Json::parse(line));
    }
    if (out.empty()) base::fail("there are no results of {}; run `gnomon sweep experiments/quality/{}.json`", experiment, experiment);
    return out;
}

/// Whether a run is of this choice. Parameters that came after it are not in its line.
bool is_of(const Json& run, const shadow::TechniqueInfo& info, const shadow::ParamValues& params)
{
    if (run.at("technique") != std::string(info.id) || run.contains("skipped")) return false;
    const Json own = params.json();
    for (const auto& [name, value] : run.at("params").items())
        if (!own.contains(name) || own[name] != value) return false;
    return true;
}

std::map<std::string, const Json*> by_scene(const std::vector<Json>& runs, std::string_view light, const auto& wanted)
{
    std::map<std::string, const Json*> out;
    for (const Json& run : runs)
        if (run.at("light") == std::string(light) && wanted(run)) out[run.at("scene")] = &run;
    return out;
}

double least_ms(const Json& run) { return run.at("technique_least_ms").get<double>(); }

/// A number with four digits: what a reader can use, and what another machine's last bits do not change.
Json rounded(double value) { return Json::parse(fmt::format("{:.4g}", value)); }

std::string size_text(const Json& run) { return fmt::format("{}x{}", run.at("size")[0].get<int>(), run.at("size")[1].get<int>()); }

Json price_of(const std::vector<Json>& runs, const shadow::Quality& q, const shadow::TechniqueInfo& baseline, const std::string& experiment)
{
    const shadow::ParamValues defaults(baseline.params());
    const auto own = by_scene(runs, q.area ? with_area : without_area, [&](const Json& run) { return is_of(run, *q.technique, q.params); });
    const auto yardstick = by_scene(runs, without_area, [&](const Json& run) { return is_of(run, baseline, defaults); });
    if (own.empty())
        base::fail("{} was not measured by {}; add it there and sweep again", choice_text({q.technique, q.params}), experiment);
    double time = 0, least = 1e300, most = 0, bytes = 0, mae = 0, wrong = 0;
    for (const auto& [scene, run] : own) {
        const auto found = yardstick.find(scene);
        if (found == yardstick.end()) base::fail("{} has no run of the baseline on {}", experiment, scene);
        const double ratio = least_ms(*run) / least_ms(*found->second);
        time += ratio, least = std::min(least, ratio), most = std::max(most, ratio);
        bytes += run->at("bytes").get<double>(), mae += run->at("metrics").at("mae").get<double>();
        wrong += q.area ? 0.0 : run->at("metrics").at("wrong_pixels").get<double>();
    }
    const double count = double(own.size());
    std::vector<std::string> scenes;
    for (const auto& [scene, run] : own) scenes.push_back(scene);
    Json out = {{"where", fmt::format("{} at {}", fmt::join(scenes, ", "), size_text(*own.begin()->second))},
        {"time", rounded(time / count)}, {"least_time", rounded(least)}, {"most_time", rounded(most)},
        {"mib", rounded(bytes / count / 1048576.0)}, {"mae", rounded(mae / count)}};
    if (!q.area) out["wrong_pixels"] = rounded(wrong / count);
    return out;
}

} // namespace

std::string priced_qualities(const fs::path& root)
{
    Json json = Json::parse(base::read_text(root / "src" / "shadow" / "quality.json"));
    const shadow::QualityTable table = shadow::parse_qualities(json.dump());
    const shadow::TechniqueInfo& baseline = shadow::technique("shadow_map");
    std::set<std::string> devices;
    for (size_t i = 0; i < table.entries.size(); ++i) {
        const shadow::Quality& q = table.entries[i];
        const std::string experiment = fmt::format("quality_{}_{}", scene::kind_name(q.light), q.area ? with_area : without_area);
        const std::vector<Json> runs = read_results(root, experiment);
        for (const Json& run : runs) devices.insert(run.at("device").get<std::string>() + " (" + run.at("driver").get<std::string>() + ")");
        json["entries"][i]["price"] = price_of(runs, q, baseline, experiment);
    }
    json["measured"] = fmt::format("Measured on {}. Numbers are means over the scenes; time is the least of some frames, its unit "
                                   "that of `shadow_map` with its defaults in the same sweep, under the same light shrunk to a point.",
        fmt::join(devices, " and "));
    return json.dump(1) + "\n";
}

} // namespace gnomon::lab
