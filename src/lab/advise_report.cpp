// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace gnomon::lab {

namespace {

using Json = nlohmann::ordered_json;

Json measured_json(const Measured& m, const std::string& metric)
{
    return {{"technique", m.choice.info->id}, {"choice", choice_text(m.choice)}, {"params", m.choice.params.json()},
        {metric, m.reading.error}, {"ms", m.reading.ms}, {"mean_ms", m.reading.mean_ms}, {"deviation_ms", m.reading.deviation_ms},
        {"bytes", m.reading.bytes}, {"within_budget", m.excess == 0}};
}

double mib(const Measured& m) { return double(m.reading.bytes) / 1048576.0; }

/// One line for each reason, since many share it.
std::string left_out_text(const Advice& a)
{
    std::vector<std::pair<std::string, std::string>> lines;
    for (const LeftOut& l : a.left_out) {
        const auto same = std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == l.why; });
        if (same == lines.end())
            lines.emplace_back(l.why, l.what);
        else
            same->second += ", " + l.what;
    }
    std::string out;
    for (const auto& [why, what] : lines) out += fmt::format("- left out: {} ({})\n", what, why);
    return out;
}

/// All of them, defaults too, as an engine takes them.
std::string params_text(const Choice& choice)
{
    std::string out, line = "  with";
    for (const shadow::ParamInfo& p : choice.params.table().fields) {
        const std::string item = fmt::format(" {}={}", p.name, choice.params.text(p));
        if (line.size() + item.size() > 120) out += line + "\n", line = "      ";
        line += item;
    }
    return choice.params.table().fields.empty() ? "" : out + line + "\n";
}

} // namespace

Json advice_json(const Advice& a)
{
    Json out = {{"scene", a.scene}, {"camera", a.camera}, {"light", a.light}, {"size", {a.size.width, a.size.height}}, {"device", a.device},
        {"driver", a.driver}, {"commit", a.commit}, {"metric", a.metric}, {"budget", a.budget}, {"features", features_json(a.features)},
        {"candidates", a.candidates}, {"techniques", a.techniques}};
    if (a.reference_ms > 0) out["reference"] = a.reference, out["reference_ms"] = a.reference_ms;
    if (a.chosen)
        out["choice"] = measured_json(*a.chosen, a.metric);
    else
        out["nothing"] = a.nothing;
    const auto list = [&](const std::vector<Measured>& all) {
        Json items = Json::array();
        for (const Measured& m : all) items.push_back(measured_json(m, a.metric));
        return items;
    };
    out["front"] = list(a.front), out["measured"] = list(a.measured);
    if (a.best) out["best"] = measured_json(*a.best, a.metric);
    if (a.best && a.chosen) out["regret"] = a.regret;
    out["reasons"] = a.reasons, out["left_out"] = Json::array();
    for (const LeftOut& l : a.left_out) out["left_out"].push_back({{"what", l.what}, {"why", l.why}});
    return out;
}

std::string advice_text(const Advice& a)
{
    std::string out = fmt::format("{}, {}, {}, {}x{} on {}\n", a.scene, a.camera, a.light, a.size.width, a.size.height, a.device);
    for (const std::string& reason : a.reasons) out += fmt::format("- {}\n", reason);
    out += left_out_text(a);
    out += fmt::format(
        "  {:>10} {:>9} {:>9}  {}\n", a.metric, "ms", "MiB", "errors against times, the front; times are the least of some frames");
    for (const Measured& m : a.front)
        out += fmt::format("  {:10.4g} {:9.3f} {:9.2f}  {}{}\n", m.reading.error, m.reading.ms, mib(m), choice_text(m.choice),
            m.excess > 0 ? "  (over the budget)" : "");
    if (a.chosen) out += fmt::format("take {}\n{}", choice_text(a.chosen->choice), params_text(a.chosen->choice));
    if (a.best && a.chosen)
        out += fmt::format("of all {} at full size, {} errs least within the budget: {} {:.4g}; the choice loses {:.1f} %\n", a.candidates,
            choice_text(a.best->choice), a.metric, a.best->reading.error, 100.0 * a.regret);
    return out;
}

std::string advice_page(const std::vector<Advice>& all)
{
    if (all.empty()) return "";
    const bool exhaustive = std::any_of(all.begin(), all.end(), [](const Advice& a) { return a.best.has_value(); });
    const Advice& first = all.front();
    std::string out
        = fmt::format("Device: {}, {}. Budget: {}. Error: {}.\n\n| scene | light | of settings, at full size | choice | {} | ms | MiB |{}\n"
                      "| --- | --- | --- | --- | --- | --- | --- |{}\n",
            first.device, first.driver, first.budget.empty() ? "none" : fmt::format("{}", fmt::join(first.budget, ", ")), first.metric,
            first.metric, exhaustive ? fmt::format(" best of all | its {} | its ms | regret |", first.metric) : "",
            exhaustive ? " --- | --- | --- | --- |" : "");
    double worst = 0;
    for (const Advice& a : all) {
        out += fmt::format("| {} | {} | {}, {} | ", a.scene, a.light, a.candidates, a.measured.size());
        if (a.chosen)
            out += fmt::format("`{}` | {:.5f} | {:.2f} | {:.1f} |", choice_text(a.chosen->choice), a.chosen->reading.error,
                a.chosen->reading.ms, mib(*a.chosen));
        else
            out += fmt::format("{} | | | |", a.nothing);
        if (a.best && a.chosen) {
            out += fmt::format(" `{}` | {:.5f} | {:.2f} | {:.1f} % |", choice_text(a.best->choice), a.best->reading.error,
                a.best->reading.ms, 100.0 * a.regret);
            worst = std::max(worst, a.regret);
        } else if (exhaustive)
            out += " | | | |";
        out += "\n";
    }
    if (exhaustive) out += fmt::format("\nLargest regret: {:.1f} %.\n", 100.0 * worst);
    return out;
}

} // namespace gnomon::lab
