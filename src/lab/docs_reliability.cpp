// SPDX-License-Identifier: Apache-2.0
#include "lab/docs_reliability.h"

#include "base/error.h"
#include "base/file.h"

#include <nlohmann/json.hpp>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// The list under `key` of a file of results; empty where there is no such file.
Json rows(const fs::path& file, const char* key = "rows")
{
    if (!fs::exists(file)) return Json::array();
    const Json json = Json::parse(base::read_text(file), nullptr, false);
    if (json.is_discarded() || !json.contains(key) || !json.at(key).is_array())
        base::fail("{} is no file of results with a list '{}'; run ./dev robustness again", file.string(), key);
    return json.at(key);
}

std::string cell(const Json& row, const char* key)
{
    if (!row.contains(key)) return "";
    const Json& v = row.at(key);
    if (v.is_boolean()) return v.get<bool>() ? "**yes**" : "none";
    if (v.is_number_float()) return fmt::format("{:.4g}", v.get<double>());
    return v.is_string() ? v.get<std::string>() : v.dump();
}

using Columns = std::vector<std::pair<const char*, const char*>>; ///< heading, key

std::string table(const std::string& title, const Json& list, const Columns& columns)
{
    if (list.empty()) return fmt::format("### {}\n\nNot run yet: `./dev robustness` does.\n\n", title);
    std::string head = "|", line = "|", body;
    for (const auto& [heading, key] : columns) head += fmt::format(" {} |", heading), line += " --- |";
    for (const Json& row : list) {
        body += "|";
        for (const auto& column : columns) body += fmt::format(" {} |", cell(row, column.second));
        body += "\n";
    }
    return fmt::format("### {}\n\n{}\n{}\n{}\n", title, head, line, body);
}

} // namespace

std::string reliability_tables(const fs::path& root)
{
    const auto joined = [](Json a, const Json& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    };
    const fs::path folder = root / "experiments" / "results" / "reliability";
    return table("Faults injected", rows(folder / "faults.json"),
               {{"fault", "fault"}, {"where", "technique"}, {"places", "calls"}, {"tried", "tried"},
                   {"ended in a sentence or by the signal", "refused"}, {"failures", "failures"}})
        + table("Soak", rows(folder / "soak.json"),
            {{"frames", "frames"}, {"rounds", "rounds"}, {"device memory, MiB", "device_mib"}, {"handles", "handles"},
                {"resident, MiB", "resident_mib"}, {"grown since the second round, MiB", "resident_grown_mib"}, {"seconds", "seconds"},
                {"failures", "failures"}})
        + table("Limits", rows(folder / "limits.json"),
            {{"limit", "limit"}, {"what happened", "outcome"}, {"seconds", "seconds"}, {"peak, MiB", "peak_mib"}})
        + table("Determinism", rows(folder / "determinism.json"),
            {{"technique", "technique"}, {"how", "how"}, {"pictures", "pictures"}, {"failures", "failures"}})
        + table("Sanitizers and validation", joined(rows(folder / "checks.json"), rows(folder / "threads.json")),
            {{"check", "check"}, {"of what", "subject"}, {"result", "outcome"}})
        + table("Fuzzing", rows(folder / "fuzz.json", "fuzz"),
            {{"target", "target"}, {"seconds", "seconds"}, {"executions", "executions"}, {"corpus files", "corpus_files"},
                {"edges", "edges"}, {"crashes", "crashes"}});
}

} // namespace gnomon::lab
