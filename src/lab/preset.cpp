// SPDX-License-Identifier: Apache-2.0
#include "lab/preset.h"

#include "base/error.h"
#include "base/file.h"
#include "lab/json_keys.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gnomon::lab {

using Json = nlohmann::ordered_json;

namespace {

Json quantities_json(const std::vector<Preset::Place>& places, std::map<std::string, double> Preset::Place::*values)
{
    Json out = Json::object();
    for (const Preset::Place& p : places)
        for (const auto& [quantity, value] : p.*values) out[quantity] = out.value(quantity, 0.0) + value / double(places.size());
    return out;
}

Json places_json(const std::vector<Preset::Place>& places)
{
    const Ratios all = ratios(places);
    Json out = {{"ratio", all.mean}, {"standard_error", all.error}, {"terms", all.terms},
        {"before", quantities_json(places, &Preset::Place::before)}, {"after", quantities_json(places, &Preset::Place::after)},
        {"places", Json::array()}};
    for (const Preset::Place& p : places) {
        Json one = {{"scene", p.scene}, {"camera", p.camera}, {"light", p.light}, {"size", {p.size.width, p.size.height}},
            {"ratio", p.ratio()}, {"before", p.before}, {"after", p.after}};
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

double Preset::Place::ratio() const { return std::accumulate(ratios.begin(), ratios.end(), 0.0) / double(ratios.size()); }

bool Ratios::gained() const
{
    constexpr double least = 0.005, dear = 0.01;
    return mean < 1 - std::max(error, least) && std::all_of(terms.begin(), terms.end(), [](double t) { return t <= 1 + dear; });
}

Ratios ratios(const std::vector<Preset::Place>& places)
{
    if (places.empty()) return {};
    const double n = double(places.size());
    Ratios out{0, 0, std::vector<double>(places.front().ratios.size())};
    for (const Preset::Place& p : places) {
        out.mean += p.ratio() / n;
        for (size_t t = 0; t < out.terms.size(); ++t) out.terms[t] += p.ratios[t] / n;
    }
    for (const Preset::Place& p : places) out.error += (p.ratio() - out.mean) * (p.ratio() - out.mean);
    out.error = places.size() > 1 ? std::sqrt(out.error / (n - 1) / n) : 0;
    return out;
}

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
        const Json json = parse_json(text, file);
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
