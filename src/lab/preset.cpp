// SPDX-License-Identifier: Apache-2.0
#include "lab/preset.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/json_keys.h"

#include <algorithm>

namespace gnomon::lab {

using Json = nlohmann::ordered_json;

namespace {

double mean(const std::vector<Preset::Place>& places, double Preset::Place::*value)
{
    double sum = 0;
    for (const Preset::Place& p : places) sum += p.*value;
    return places.empty() ? 0 : sum / double(places.size());
}

Json places_json(const std::vector<Preset::Place>& places)
{
    Json out = {{"before", mean_before(places)}, {"after", mean_after(places)}, {"places", Json::array()}};
    for (const Preset::Place& p : places) {
        Json one = {{"scene", p.scene}, {"camera", p.camera}, {"light", p.light}, {"size", {p.size.width, p.size.height}},
            {"before", p.before}, {"after", p.after}};
        if (p.time_ratio > 0) one["time_ratio"] = p.time_ratio;
        out["places"].push_back(one);
    }
    return out;
}

/// What was searched, and what else differs from the defaults; the rest is left to later defaults.
Json params_json(const Preset& preset)
{
    Json out = Json::object();
    const Json all = preset.choice.params.json(), defaults = shadow::ParamValues(preset.choice.info->params()).json();
    for (const auto& [name, value] : all.items())
        if (value != defaults.at(name) || std::find(preset.vary.begin(), preset.vary.end(), name) != preset.vary.end()) out[name] = value;
    return out;
}

} // namespace

double mean_before(const std::vector<Preset::Place>& places) { return mean(places, &Preset::Place::before); }
double mean_after(const std::vector<Preset::Place>& places) { return mean(places, &Preset::Place::after); }

Json preset_json(const Preset& preset)
{
    Json out = {{"format", 1}, {"technique", preset.choice.info->id}, {"params", params_json(preset)}, {"vary", preset.vary},
        {"minimise", preset.minimise}, {"under", preset.under}};
    if (!preset.reference.empty()) out["reference"] = preset.reference;
    out["tuning"] = places_json(preset.tuning);
    if (!preset.validation.empty()) out["validation"] = places_json(preset.validation);
    out.update(Json{{"evaluations", preset.evaluations}, {"seed", preset.seed}, {"device", preset.device}, {"driver", preset.driver},
        {"commit", preset.commit}});
    return out;
}

void write_preset(const std::filesystem::path& file, const Preset& preset) { base::write_text(file, preset_json(preset).dump(1) + "\n"); }

Choice read_preset_choice(const std::filesystem::path& file)
{
    const std::string text = base::read_text(file, uint64_t(1) << 20);
    return naming(file, [&] {
        const Json json = Json::parse(text);
        known_keys(json,
            {"format", "technique", "params", "vary", "minimise", "under", "reference", "tuning", "validation", "evaluations", "seed",
                "device", "driver", "commit"},
            file);
        if (json.value("format", Json()) != 1)
            base::fail("{}: \"format\" is not 1; the file is no preset, or of another version", file.string());
        const shadow::TechniqueInfo& info = shadow::technique(json.at("technique").get<std::string>());
        Choice out{&info, shadow::ParamValues(info.params())};
        out.params.set_json(json.value("params", Json::object()));
        return out;
    });
}

} // namespace gnomon::lab
