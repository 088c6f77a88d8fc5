// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "lab/sweep.h"

#include <fmt/format.h>

#include <charconv>

namespace gnomon::cli {

namespace fs = std::filesystem;

namespace {

void parse_shard(const std::string& text, lab::SweepOptions& options)
{
    if (text.empty()) return;
    const char* end = text.data() + text.size();
    const auto [slash, first] = std::from_chars(text.data(), end, options.shard);
    if (first == std::errc() && slash != end && *slash == '/') {
        const auto [last, second] = std::from_chars(slash + 1, end, options.shards);
        if (second == std::errc() && last == end && options.shard >= 1 && options.shard <= options.shards) return;
    }
    base::fail("--shard takes I/N, as 2/3 for the second of three parts, not '{}'", text);
}

void print(const Common& common, const lab::SweepReport& report)
{
    for (const std::string& note : report.notes) fmt::print(stderr, "gnomon: note: {}\n", note);
    if (common.json) {
        nlohmann::ordered_json files = nlohmann::ordered_json::array();
        for (const fs::path& file : report.files) files.push_back(file.string());
        fmt::print("{}\n",
            nlohmann::ordered_json{{"results", report.results.string()}, {"runs", report.runs}, {"made", report.made},
                {"skipped", report.skipped}, {"files", files}, {"notes", report.notes}}
                .dump(1));
        return;
    }
    fmt::print("{} runs, {} of them made now, {} skipped by their techniques: {}\n", report.runs, report.made, report.skipped,
        report.results.string());
    for (const fs::path& file : report.files) fmt::print("{}\n", file.string());
}

int plan(const Sweep& options, const lab::Experiment& experiment)
{
    const std::vector<const lab::Cell*> runs = lab::distinct_runs(experiment);
    if (options.common.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const lab::Cell* cell : runs)
            all.push_back({{"key", cell->key}, {"columns", cell->columns}, {"choice", lab::choice_text(cell->choice)}});
        fmt::print("{}\n", nlohmann::ordered_json{{"combinations", experiment.cells.size()}, {"runs", all}}.dump(1));
        return 0;
    }
    for (const lab::Cell* cell : runs) fmt::print("{}  {}\n", lab::cell_name(experiment, *cell), lab::choice_text(cell->choice));
    fmt::print("{} combinations, {} different runs\n", experiment.cells.size(), runs.size());
    return 0;
}

} // namespace

int sweep(const Sweep& options)
{
    lab::SweepOptions sweep{.folder = options.output, .again = options.again};
    parse_shard(options.shard, sweep);
    const lab::Experiment experiment = lab::read_experiment(options.experiment);
    if (options.plan) return plan(options, experiment);
    const auto device = open_device(options.common);
    if (options.output.empty()) sweep.folder = lab::default_results_folder(device->info().name, experiment);
    const lab::SweepReport report = lab::sweep(*device, experiment, sweep);
    demand_valid(*device);
    print(options.common, report);
    if (sweep.shards > 1 && !options.common.json)
        fmt::print("when all {} shards are done: gnomon merge {} {}/results.*.jsonl -o {}\n", sweep.shards, options.experiment,
            sweep.folder.string(), sweep.folder.string());
    return 0;
}

int merge(const Merge& options)
{
    const lab::Experiment experiment = lab::read_experiment(options.experiment);
    const std::vector<fs::path> files(options.files.begin(), options.files.end());
    const fs::path folder = options.output.empty() ? fs::absolute(files.front()).parent_path() : fs::path(options.output);
    print(options.common, lab::merge(experiment, files, folder));
    return 0;
}

} // namespace gnomon::cli
