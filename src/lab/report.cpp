// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "lab/compare.h"
#include "lab/plot.h"
#include "lab/sequence.h"
#include "metrics/metrics.h"
#include "metrics/temporal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <report_html.h>
#include <report_js.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::lab {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string base64(const std::vector<std::byte>& bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t three = 0;
        for (size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return out;
}

/// Runs under a light that nothing else beats in both time and error, by time.
std::vector<const Run*> front(std::vector<const Run*> runs)
{
    std::sort(runs.begin(), runs.end(), [](const Run* a, const Run* b) {
        return std::pair(a->technique_ms, a->metrics.at("mae")) < std::pair(b->technique_ms, b->metrics.at("mae"));
    });
    std::vector<const Run*> out;
    for (const Run* run : runs)
        if (out.empty() || run->metrics.at("mae") < out.back()->metrics.at("mae")) out.push_back(run);
    return out;
}

/// Below every error that can be told from 0, halfway between two powers of ten; what is smaller is drawn there.
double error_floor(const std::vector<const Run*>& runs)
{
    double least = 1.0;
    for (const Run* run : runs)
        if (run->metrics.at("mae") >= 1e-7) least = std::min(least, run->metrics.at("mae"));
    return std::pow(10.0, std::floor(std::log10(least)) - 0.5);
}

std::vector<const Run*> runs_under(const Comparison& comparison, const std::string& light)
{
    std::vector<const Run*> runs;
    for (const Run& run : comparison.runs)
        if (run.light == light && run.skipped.empty()) runs.push_back(&run);
    return runs;
}

/// The SVG of one light, or why there is none. A colour for each family, and a line through the front.
std::string draw_front(const Comparison& comparison, const std::string& light, size_t number, const fs::path& folder, std::string& refused)
{
    const std::vector<const Run*> runs = runs_under(comparison, light);
    constexpr size_t grey = 6;
    std::vector<PlotSeries> series = {{"front", grey, 0, true, {}, false}};
    for (const Run* run : front(runs)) series.front().points.push_back({"", run->technique_ms, run->metrics.at("mae"), 0});
    for (const Run* run : runs) {
        const std::string family(shadow::technique(run->technique).family);
        auto at = std::find_if(series.begin(), series.end(), [&](const PlotSeries& s) { return s.name == family; });
        if (at == series.end()) {
            const size_t color = series.size() - 1 + (series.size() > grey);
            at = series.insert(series.end(), {family, color, color, false, {}});
        }
        at->points.push_back({"", run->technique_ms, run->metrics.at("mae"), 0, run->name});
    }
    PlotSpec spec;
    spec.file = fmt::format("front.{}", number + 1);
    spec.title = fmt::format("Mean absolute error over milliseconds, {}", light);
    spec.x_label = "ms, the technique's own passes", spec.y_label = "mean absolute error of visibility", spec.log_x = spec.log_y = true;
    spec.y_floor = error_floor(runs);
    const fs::path file = folder / (spec.file + ".svg");
    refused = draw_series(spec, series, file);
    return refused.empty() ? base::read_text(file) : "";
}

/// As a page may hold it between its tags.
std::string script_text(const Json& json)
{
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), out;
    for (size_t i = 0; i < text.size(); ++i) out += text[i] == '<' ? std::string("\\u003c") : std::string(1, text[i]);
    return out;
}

void add_metrics(Json& list, const std::vector<metrics::Metric>& all)
{
    for (const metrics::Metric& m : all) list.push_back({{"id", m.id}, {"unit", m.unit}, {"help", m.help}});
}

std::string csv_text(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

} // namespace

std::string results_csv(const Comparison& comparison)
{
    std::set<std::string> ids, counts;
    for (const Run& run : comparison.runs) {
        for (const auto& [id, value] : run.metrics) ids.insert(id);
        for (const auto& [id, value] : run.counts) counts.insert(id);
    }
    std::string out = "technique,scene,camera,light,width,height,ms,ms_deviation,bytes";
    for (const std::string& id : ids) out += "," + id;
    for (const std::string& id : counts) out += ",count:" + id;
    out += ",skipped\n";
    for (const Run& run : comparison.runs) {
        out += fmt::format("{},{},{},{},{},{}", csv_text(run.name), csv_text(run.scene), csv_text(run.camera), csv_text(run.light),
            run.size.width, run.size.height);
        out += run.skipped.empty() ? fmt::format(",{},{},{}", run.technique_ms, run.technique_deviation, run.bytes) : ",,,";
        for (const std::string& id : ids) out += run.metrics.count(id) ? fmt::format(",{}", run.metrics.at(id)) : ",";
        for (const std::string& id : counts) out += run.counts.count(id) ? fmt::format(",{}", run.counts.at(id)) : ",";
        out += "," + csv_text(run.skipped) + "\n";
    }
    return out;
}

std::string report_page(const Comparison& comparison, const fs::path& folder)
{
    Json data = results_json(comparison);
    data["error_colors"] = metrics::heat_map_colors();
    data["metrics"] = Json::array();
    add_metrics(data["metrics"], metrics::metrics());
    data["metrics"].push_back(
        {{"id", "flip"}, {"unit", "0 to 1"}, {"help", "perceived difference of the lit pictures (Andersson et al. 2020)"}});
    add_metrics(data["metrics"], metrics::filter_metrics());
    add_metrics(data["metrics"], metrics::temporal_metrics());
    data["pictures"] = Json::object();
    const auto add = [&](const Pictures& pictures) {
        for (const auto& [kind, file] : pictures) data["pictures"][file] = base64(base::read_file(folder / file));
    };
    const auto quantity = [](truth::Quantity q) { return q == truth::Quantity::visibility ? "visibility" : "transmittance"; };
    for (size_t i = 0; i < comparison.runs.size(); ++i) {
        const Run& run = comparison.runs[i];
        data["runs"][i]["name"] = run.name, data["runs"][i]["pictures"] = run.pictures,
        data["runs"][i]["quantity"] = quantity(run.quantity);
        const shadow::TechniqueInfo& info = shadow::technique(run.technique);
        data["runs"][i]["title"] = info.title, data["runs"][i]["family"] = info.family, data["runs"][i]["cite"] = info.cite;
        add(run.pictures);
    }
    data["truths"] = Json::array();
    std::vector<std::string> lights;
    for (const TruthPictures& t : comparison.truths) {
        Json entry = {{"light", t.light}, {"quantity", quantity(t.quantity)}};
        for (const auto& [kind, file] : t.pictures) entry[kind] = file;
        data["truths"].push_back(entry);
        add(t.pictures);
        if (std::find(lights.begin(), lights.end(), t.light) == lights.end()) lights.push_back(t.light);
    }
    data["plots"] = Json::array();
    for (size_t i = 0; i < lights.size(); ++i) {
        for (const Run* run : front(runs_under(comparison, lights[i]))) data["runs"][size_t(run - comparison.runs.data())]["front"] = true;
        std::string refused;
        const std::string svg = draw_front(comparison, lights[i], i, folder, refused);
        if (refused.empty())
            data["plots"].push_back(svg.substr(svg.find("<svg")));
        else
            data["no_plot"] = refused;
        const fs::path changes = folder / fmt::format("change.{}.svg", i + 1);
        if (draw_changes(comparison.runs, lights[i], changes).empty()) {
            const std::string drawn = base::read_text(changes);
            data["plots"].push_back(drawn.substr(drawn.find("<svg")));
        }
    }
    std::string page(report_html);
    const auto put = [&](std::string_view place, std::string_view text) { page.replace(page.find(place), place.size(), text); };
    put("@REPORT_SCRIPT@", report_js); // before the data, which may hold any text
    put("@REPORT_DATA@", script_text(data));
    return page;
}

} // namespace gnomon::lab
