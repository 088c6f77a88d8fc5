// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"
#include "lab/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string number_text(double value)
{
    return value != 0 && std::abs(value) < 1e-4 ? fmt::format("{:.2e}", value) : fmt::format("{:.4g}", value);
}

/// RFC 4180.
std::string quoted(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

/// A cell of a Markdown table.
std::string escaped(std::string text)
{
    for (size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string csv(const Experiment& experiment, const std::vector<Row>& rows)
{
    std::vector<std::string> texts = identity_columns(), numbers;
    texts.insert(texts.end(), experiment.axes.begin(), experiment.axes.end());
    for (const std::string& column : number_columns())
        if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.number(column).has_value(); }))
            numbers.push_back(column);
    std::set<std::string> counts;
    for (const Row& row : rows)
        if (row.line->contains("counts"))
            for (const auto& [name, value] : row.line->at("counts").items()) counts.insert("count:" + name);
    numbers.insert(numbers.end(), counts.begin(), counts.end());
    std::string out = fmt::format("{},{},skipped,commit\r\n", fmt::join(texts, ","), fmt::join(numbers, ","));
    for (const Row& row : rows) {
        for (const std::string& column : texts) out += quoted(row.cell->columns.at(column)) + ",";
        for (const std::string& column : numbers) {
            const std::optional<double> value = row.number(column);
            out += (value ? fmt::format("{:.7g}", *value) : "") + ",";
        }
        out += quoted(row.line->value("skipped", "")) + "," + quoted(row.line->at("commit").get<std::string>()) + "\r\n";
    }
    return out;
}

std::string table_cell(const RowGroup& group, const std::string& column)
{
    const std::optional<double> value = group.mean(column);
    if (!value) return "-";
    if (column != "ms") return number_text(*value);
    const std::optional<double> deviation = group.rows.size() == 1 ? group.rows.front().number("ms_deviation") : std::nullopt;
    return deviation ? fmt::format("{:.2f} ± {:.2f}", *value, *deviation) : fmt::format("{:.2f}", *value);
}

std::string table(const TableSpec& spec, const std::vector<Row>& rows)
{
    const std::vector<RowGroup> groups = grouped(rows, spec.rows, spec.where);
    size_t most = 0;
    for (const RowGroup& group : groups) most = std::max(most, group.rows.size());
    std::string out = spec.title.empty() ? "" : "### " + spec.title + "\n\n";
    if (most > 1) out += fmt::format("Each row is the mean of up to {} runs.\n\n", most);
    out += fmt::format("| {} | {} |\n|", fmt::join(spec.rows, " | "), fmt::join(spec.labels, " | "));
    for (size_t i = 0; i < spec.rows.size(); ++i) out += " --- |";
    for (size_t i = 0; i < spec.columns.size(); ++i) out += " ---: |";
    out += "\n";
    for (const RowGroup& group : groups) {
        out += "|";
        for (const std::string& text : group.key) out += " " + escaped(text) + " |";
        for (const std::string& column : spec.columns) out += " " + table_cell(group, column) + " |";
        out += "\n";
    }
    for (const TableSpec::Published& row : spec.published) {
        out += "|";
        for (const std::string& text : row.texts) out += " " + escaped(text) + " |";
        for (const std::optional<double>& value : row.numbers) out += " " + (value ? number_text(*value) : "-") + " |";
        out += "\n";
    }
    return out + "\n";
}

/// Everything that differs between the lines under one key, joined.
std::string joined(const std::vector<Row>& rows, const char* key)
{
    std::set<std::string> texts;
    for (const Row& row : rows) texts.insert(row.line->value(key, "unknown"));
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string page(const Experiment& experiment, const std::vector<Row>& rows, const std::vector<std::string>& plots)
{
    std::string out = fmt::format("# {}\n\n{}{}Made by `gnomon sweep` from the experiment {}; do not edit.\n\n", experiment.title,
        experiment.about, experiment.about.empty() ? "" : "\n\n", experiment.name);
    if (rows.empty()) return out + "No run is finished yet.\n";
    out += fmt::format("- device: {} ({}); processor: {}\n- commit: {}; gnomon {}\n", joined(rows, "device"), joined(rows, "driver"),
        joined(rows, "processor"), joined(rows, "commit"), joined(rows, "gnomon"));
    out += fmt::format("- {} of {} combinations; truth with {} samples; times: mean ± deviation of {} after {} that are not counted\n\n",
        rows.size(), experiment.cells.size(), experiment.truth_samples, experiment.repeats, experiment.warm_up);
    for (const std::string& plot : plots) out += plot;
    for (const TableSpec& spec : experiment.tables) out += table(spec, rows);
    std::set<std::string> reasons;
    for (const Row& row : rows) {
        if (row.line->contains("skipped")) reasons.insert(row.line->at("skipped").get<std::string>());
        if (row.line->contains("reference_refused")) reasons.insert("no filter metrics: " + row.line->value("reference_refused", ""));
    }
    if (!reasons.empty()) out += "Not measured:\n\n";
    for (const std::string& reason : reasons) out += "- " + escaped(reason) + "\n";
    return out;
}

} // namespace

std::vector<fs::path> write_report(
    const Experiment& experiment, const Results& results, const fs::path& folder, std::vector<std::string>& notes)
{
    const std::vector<Row> rows = result_rows(experiment, results);
    std::vector<fs::path> files = {folder / "results.csv"};
    base::write_text(files.back(), csv(experiment, rows));
    std::vector<std::string> plots;
    for (const PlotSpec& plot : experiment.plots) {
        const fs::path file = folder / (plot.file + ".svg");
        const std::string reason = draw_plot(plot, rows, file);
        if (!reason.empty()) {
            if (std::find(notes.begin(), notes.end(), reason) == notes.end()) notes.push_back(reason);
            continue;
        }
        files.push_back(file);
        plots.push_back(fmt::format("![{}]({}.svg)\n\n", plot.title, plot.file));
    }
    files.push_back(folder / "README.md");
    base::write_text(files.back(), page(experiment, rows, plots));
    return files;
}

} // namespace gnomon::lab
