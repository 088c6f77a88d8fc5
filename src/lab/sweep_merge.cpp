// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/line_file.h"
#include "lab/sweep.h"

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

/// All files' results; two files may hold the same result, not two results of one run.
Results gather(const std::vector<fs::path>& files)
{
    Results all;
    std::map<std::string, fs::path> origin;
    for (const fs::path& file : files) {
        Results own;
        own.add_file(file, base::read_lines(file));
        if (!all.all().empty()) {
            const Json& first = all.all().begin()->second;
            own.demand_device(first.at("device"), first.at("driver"), file);
        }
        for (const auto& [key, line] : own.all()) {
            const Json* there = all.find(key);
            if (there && *there != line)
                base::fail("{} and {} hold different results of one run ({}, key {}); merge only one of them, or delete that line from one",
                    origin[key].string(), file.string(), line.at("technique").get<std::string>(), key);
            if (there) continue;
            all.add(line.dump(), file, 0);
            origin[key] = file;
        }
    }
    if (!all.all().empty()) {
        const Json& first = all.all().begin()->second;
        all.demand_device(first.at("device"), first.at("driver"), files.front());
    }
    return all;
}

} // namespace

SweepReport merge(const Experiment& experiment, const std::vector<fs::path>& files, const fs::path& folder)
{
    SweepReport report;
    report.results = folder / "results.jsonl";
    std::vector<fs::path> all = files;
    std::error_code error;
    const bool listed
        = std::any_of(files.begin(), files.end(), [&](const fs::path& f) { return fs::equivalent(f, report.results, error); });
    std::optional<base::LineFile> lock; // no sweep may append to a file that is replaced here
    if (fs::exists(report.results, error)) {
        lock.emplace(report.results);
        if (!listed) all.push_back(report.results);
    }
    const Results results = gather(all);

    const std::vector<const Cell*> runs = distinct_runs(experiment);
    std::string text;
    std::set<std::string> known;
    const Cell* missing = nullptr;
    for (const Cell* cell : runs) {
        known.insert(cell->key);
        if (const Json* line = results.find(cell->key))
            text += line->dump() + "\n", ++report.runs, report.skipped += line->contains("skipped");
        else if (!missing)
            missing = cell;
    }
    if (report.runs == 0)
        base::fail("{} holds no result of {}; name the files that its shards wrote", files.front().string(), experiment.file.string());
    if (missing)
        base::fail("{} of {} runs are missing, the first: {}; run and name the shard that makes them, nothing is written before",
            runs.size() - report.runs, runs.size(), cell_name(experiment, *missing));
    for (const auto& [key, line] : results.all())
        if (!known.count(key)) text += line.dump() + "\n";
    base::write_text(report.results, text);
    report.files = write_report(experiment, results, folder, report.notes);
    return report;
}

} // namespace gnomon::lab
