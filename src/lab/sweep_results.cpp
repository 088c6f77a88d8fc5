// SPDX-License-Identifier: Apache-2.0
#include "lab/sweep.h"

#include "base/error.h"
#include "base/json_depth.h"

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

bool is_pass(const Json& pass)
{
    const auto is = [&](const char* key, bool (Json::*type)() const noexcept) { return !pass.contains(key) || (pass[key].*type)(); };
    return pass.is_object() && is("name", &Json::is_string) && is("count", &Json::is_number_unsigned);
}

bool is_result(const Json& json)
{
    if (!json.is_object() || json.value("format", Json()) != 1) return false;
    for (const char* key : {"key", "device", "driver", "commit", "technique"})
        if (!json.contains(key) || !json[key].is_string()) return false;
    if (json.contains("skipped")) return json["skipped"].is_string();
    if (!json.contains("metrics") || !json["metrics"].is_object() || !json.contains("passes") || !json["passes"].is_array()) return false;
    return std::all_of(json["passes"].begin(), json["passes"].end(), is_pass);
}

std::optional<double> number_at(const Json& object, const std::string& key)
{
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return {};
    return found->get<double>();
}

/// Whether `patterns`, joined by '+', name a pass or a count: each is its name, or ends in '*' and begins it.
bool names_pass(std::string_view patterns, std::string_view pass)
{
    for (size_t from = 0; from <= patterns.size();) {
        const size_t to = std::min(patterns.find('+', from), patterns.size());
        const std::string_view one = patterns.substr(from, to - from);
        if (one == pass || (!one.empty() && one.back() == '*' && pass.substr(0, one.size() - 1) == one.substr(0, one.size() - 1)))
            return true;
        from = to + 1;
    }
    return false;
}

/// Of the passes whose names begin with `owner`, the sum of those that `patterns` names; nothing where there are none.
std::optional<double> pass_ms(const Json& line, const std::string& owner, std::string_view patterns)
{
    std::optional<double> sum;
    for (const Json& pass : line.at("passes")) {
        const std::string name = pass.value("name", "");
        if (name.rfind(owner, 0) != 0 || !names_pass(patterns, std::string_view(name).substr(owner.size()))) continue;
        if (const std::optional<double> ms = number_at(pass, "ms")) sum = sum.value_or(0.0) + *ms;
    }
    return sum;
}

/// The sum of those numbers that the technique counts and `patterns` names; nothing where there are none.
std::optional<double> counted(const Json& line, std::string_view patterns)
{
    std::optional<double> sum;
    const auto counts = line.find("counts");
    if (counts == line.end() || !counts->is_object()) return sum;
    for (const auto& [name, value] : counts->items())
        if (names_pass(patterns, name) && value.is_number()) sum = sum.value_or(0.0) + value.get<double>();
    return sum;
}

size_t own_passes(const Json& line)
{
    size_t count = 0;
    const std::string owner = line.at("technique").get<std::string>() + "/";
    for (const Json& pass : line.at("passes"))
        if (pass.value("name", "").rfind(owner, 0) == 0) count += pass.value("count", size_t(1));
    return count;
}

} // namespace

void Results::add(const std::string& line, const fs::path& file, size_t number)
{
    base::check_json_depth(line, file.string());
    Json json = Json::parse(line, nullptr, false);
    if (!is_result(json))
        base::fail(
            "{}, line {} is no result of `gnomon sweep`; delete that line (its run is then made again), or choose another folder with -o",
            file.string(), number);
    std::string key = json["key"];
    lines_[std::move(key)] = std::move(json);
}

void Results::add_file(const fs::path& file, const std::vector<std::string>& lines)
{
    for (size_t i = 0; i < lines.size(); ++i) add(lines[i], file, i + 1);
}

const Json* Results::find(const std::string& key) const
{
    const auto found = lines_.find(key);
    return found == lines_.end() ? nullptr : &found->second;
}

void Results::demand_device(const std::string& device, const std::string& driver, const fs::path& file) const
{
    for (const auto& [key, line] : lines_)
        if (line.at("device") != device || line.at("driver") != driver)
            base::fail("{} holds results of {} ({}), which are never mixed with those of {} ({}); choose another folder with -o",
                file.string(), line.at("device").get<std::string>(), line.at("driver").get<std::string>(), device, driver);
}

std::vector<const Cell*> distinct_runs(const Experiment& experiment)
{
    std::vector<const Cell*> out;
    std::set<std::string> seen;
    for (const Cell& cell : experiment.cells)
        if (seen.insert(cell.key).second) out.push_back(&cell);
    return out;
}

std::string cell_name(const Experiment& experiment, const Cell& cell)
{
    std::string out;
    for (const std::string& column : identity_columns()) out += (out.empty() ? "" : ", ") + cell.columns.at(column);
    for (const std::string& axis : experiment.axes) out += fmt::format(", {}={}", axis, cell.columns.at(axis));
    return out;
}

std::optional<double> Row::number(const std::string& column) const
{
    if (line->contains("skipped")) return {};
    if (column == "ms") return number_at(*line, "technique_ms");
    if (column == "ms_deviation") return number_at(*line, "technique_deviation");
    if (column == "gbuffer_ms") return pass_ms(*line, "", "gbuffer");
    if (column.rfind("pass:", 0) == 0) return pass_ms(*line, line->at("technique").get<std::string>() + "/", column.substr(5));
    if (column.rfind("count:", 0) == 0) return counted(*line, column.substr(6));
    if (column == "passes") return double(own_passes(*line));
    if (column == "scored_pixels" || column == "excluded_pixels") return number_at(*line, column);
    if (column != "mib") return number_at(line->at("metrics"), column);
    const std::optional<double> bytes = number_at(*line, "bytes");
    return bytes ? std::optional<double>(*bytes / 1048576.0) : bytes;
}

std::optional<double> RowGroup::mean(const std::string& column) const
{
    double sum = 0;
    size_t count = 0;
    for (const Row& row : rows)
        if (const std::optional<double> value = row.number(column)) sum += *value, ++count;
    return count ? std::optional<double>(sum / double(count)) : std::nullopt;
}

std::vector<Row> result_rows(const Experiment& experiment, const Results& results)
{
    std::vector<Row> out;
    for (const Cell& cell : experiment.cells)
        if (const Json* line = results.find(cell.key)) out.push_back({&cell, line});
    return out;
}

std::vector<RowGroup> grouped(const std::vector<Row>& rows, const std::vector<std::string>& columns, const Where& where)
{
    std::vector<RowGroup> out;
    std::map<std::vector<std::string>, size_t> places;
    for (const Row& row : rows) {
        const bool taken = std::all_of(where.begin(), where.end(),
            [&](const auto& w) { return std::find(w.second.begin(), w.second.end(), row.cell->columns.at(w.first)) != w.second.end(); });
        if (!taken) continue;
        std::vector<std::string> key;
        for (const std::string& column : columns) key.push_back(row.cell->columns.at(column));
        const auto [place, fresh] = places.try_emplace(key, out.size());
        if (fresh) out.push_back({key, {}});
        out[place->second].rows.push_back(row);
    }
    return out;
}

} // namespace gnomon::lab
