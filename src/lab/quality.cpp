// SPDX-License-Identifier: Apache-2.0
#include "lab/quality.h"

#include "base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::lab {

using namespace shadow;

namespace {

Choice choice_of(const Quality& q) { return {q.technique, q.params}; }

std::string light_text(const Quality& q)
{
    const bool always = q.light == scene::LightKind::rect || q.light == scene::LightKind::disk;
    return std::string(scene::kind_name(q.light)) + (always ? "" : q.area ? ", with an area" : ", without area");
}

/// Two digits are what a busy machine leaves of a ratio.
std::string ratio_text(double v) { return v < 9.95 ? fmt::format("{:.2g}", v) : fmt::format("{:.0f}", v); }

/// "1.2 (0.8 to 2)"
std::string time_text(const Price& p)
{
    return fmt::format("{} ({} to {})", ratio_text(p.time), ratio_text(p.least_time), ratio_text(p.most_time));
}

} // namespace

Choice quality_choice(const std::string& level, const gpu::Device& device, std::span<const scene::Light> lights)
{
    const Level parsed = parse_level(level);
    if (lights.empty()) base::fail("a quality needs a light to be chosen for; name one with --light");
    const Choice first = choice_of(choose_quality(parsed, device, lights.front()));
    for (const scene::Light& light : lights.subspan(1)) {
        const std::string other = choice_text(choice_of(choose_quality(parsed, device, light)));
        if (other != choice_text(first))
            base::fail("quality {} means {} for the light {} and {} for {}; render them one at a time", level, choice_text(first),
                lights.front().name, other, light.name);
    }
    return first;
}

nlohmann::ordered_json qualities_json()
{
    const QualityTable& table = qualities();
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    for (const Quality& q : table.entries) {
        nlohmann::ordered_json entry = {{"light", scene::kind_name(q.light)}, {"area", q.area}, {"level", level_name(q.level)},
            {"technique", choice_text(choice_of(q))}};
        if (q.price) {
            entry["price"] = {{"where", q.price->where}, {"time", q.price->time}, {"least_time", q.price->least_time},
                {"most_time", q.price->most_time}, {"mib", q.price->mib}, {"mae", q.price->mae}};
            if (q.price->wrong_pixels) entry["price"]["wrong_pixels"] = *q.price->wrong_pixels;
        }
        entries.push_back(entry);
    }
    return {{"measured", table.measured}, {"baseline", table.baseline}, {"entries", entries}};
}

std::string qualities_text()
{
    const QualityTable& table = qualities();
    std::string out = fmt::format("{}\n", table.measured), light;
    for (const Quality& q : table.entries) {
        if (light_text(q) != light) {
            light = light_text(q);
            out += fmt::format("\n{}: {}\n  {:<8} {:<20} {:>8} {:>10} {:>10}  technique\n", light,
                q.price ? q.price->where : "not measured", "", "time", "MiB", "mae", "wrong");
        }
        const Price p = q.price.value_or(Price{});
        out += fmt::format("  {:<8} {:<20} {:>8.4g} {:>10.3g} {:>10}  {}\n", level_name(q.level), time_text(p), p.mib, p.mae,
            p.wrong_pixels ? fmt::format("{:.3g}", *p.wrong_pixels) : "-", choice_text(choice_of(q)));
    }
    return out;
}

std::string qualities_page(const QualityTable& table)
{
    std::string out = fmt::format("{}\n", table.measured), light;
    for (const Quality& q : table.entries) {
        if (light_text(q) != light) {
            light = light_text(q);
            out += fmt::format(
                "\n**{}**: {}\n\n| level | technique | time | MiB | mae | wrong pixels |\n| --- | --- | --- | ---: | ---: | ---: |\n",
                light, q.price ? q.price->where : "not measured");
        }
        const Price p = q.price.value_or(Price{});
        out += fmt::format("| {} | `{}` | {} | {:.4g} | {:.3g} | {} |\n", level_name(q.level), choice_text(choice_of(q)), time_text(p),
            p.mib, p.mae, p.wrong_pixels ? fmt::format("{:.3g}", *p.wrong_pixels) : "");
    }
    return out;
}

} // namespace gnomon::lab
