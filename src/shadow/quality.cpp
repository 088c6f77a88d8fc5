// SPDX-License-Identifier: Apache-2.0
#include "shadow/quality.h"

#include "base/error.h"
#include "base/names.h"

#include <nlohmann/json.hpp>
#include <quality_json.h>

#include <algorithm>
#include <array>

namespace gnomon::shadow {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, level_count> level_names = {"low", "medium", "high", "exact"};

scene::LightKind parse_kind(const std::string& name)
{
    for (int k = 0; k < scene::light_kind_count; ++k)
        if (scene::kind_name(scene::LightKind(k)) == name) return scene::LightKind(k);
    base::fail("quality.json has an entry for the light '{}', which is no kind of light", name);
}

Price parse_price(const Json& json)
{
    Price out{json.at("where"), json.at("time"), json.at("least_time"), json.at("most_time"), json.at("mib"), json.at("mae"), {}};
    if (json.contains("wrong_pixels")) out.wrong_pixels = json["wrong_pixels"].get<double>();
    return out;
}

Quality parse_entry(const Json& json)
{
    const TechniqueInfo& info = technique(json.at("technique").get<std::string>());
    Quality out{parse_kind(json.at("light")), json.at("area"), parse_level(json.at("level").get<std::string>()), &info,
        ParamValues(info.params()), {}};
    if (json.contains("params")) out.params.set_json(json["params"]);
    if (json.contains("price")) out.price = parse_price(json["price"]);
    if (!(info.lights & light_bit(out.light)))
        base::fail("quality.json gives {} to {} lights, which it does not take", info.id, scene::kind_name(out.light));
    return out;
}

} // namespace

std::string_view level_name(Level level) { return level_names[size_t(level)]; }

Level parse_level(std::string_view name)
{
    const auto found = std::find(level_names.begin(), level_names.end(), name);
    if (found != level_names.end()) return Level(found - level_names.begin());
    const std::vector<std::string> names(level_names.begin(), level_names.end());
    throw base::Error(base::unknown_name("quality", name, names));
}

QualityTable parse_qualities(const std::string& text)
{
    try {
        const Json json = Json::parse(text);
        QualityTable out{json.at("measured"), json.at("baseline"), {}};
        for (const Json& entry : json.at("entries")) out.entries.push_back(parse_entry(entry));
        return out;
    } catch (const Json::exception& e) {
        base::fail("quality.json cannot be read: {}", e.what());
    }
}

const QualityTable& qualities()
{
    static const QualityTable table = parse_qualities(std::string(quality_json));
    return table;
}

const Quality& choose_quality(Level level, const gpu::Device& device, const scene::Light& light)
{
    std::string reasons;
    for (const Quality& q : qualities().entries) {
        if (q.level != level || q.light != light.kind() || q.area != light.soft()) continue;
        const std::string reason = refusal(*q.technique, device, light);
        if (reason.empty()) return q;
        reasons += reason + "; ";
    }
    base::fail("nothing of quality {} runs here for this {} light: {}name a technique instead", level_name(level),
        scene::kind_name(light.kind()), reasons);
}

} // namespace gnomon::shadow
