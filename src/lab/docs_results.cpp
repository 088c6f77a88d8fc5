// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "base/line_file.h"
#include "base/temporary_folder.h"
#include "lab/folder.h"
#include "lab/sweep.h"

#include <algorithm>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

std::optional<fs::path> experiment_file(const fs::path& root, const std::string& name)
{
    if (const fs::path own = root / "experiments" / name / "experiment.json"; fs::exists(own)) return own;
    for (const fs::directory_entry& folder : fs::directory_iterator(root / "experiments"))
        if (const fs::path file = folder.path() / (name + ".json"); fs::exists(file)) return file;
    return {};
}

/// Another gnuplot writes other bytes for the same plot: then nothing is known.
bool of_other_gnuplots(const std::string& a, const std::string& b)
{
    const auto producer = [](const std::string& text) {
        const size_t at = text.find("Produced by GNUPLOT");
        return at == std::string::npos ? std::string() : text.substr(at, text.find('\n', at) - at);
    };
    return producer(a) != producer(b);
}

/// Makes a sweep's page, table and plots from its line file; the stale ones.
std::vector<fs::path> update_sweep(const fs::path& folder, const Experiment& experiment, bool check)
{
    Results results;
    results.add_file(folder / "results.jsonl", base::read_lines(folder / "results.jsonl"));
    const base::TemporaryFolder made;
    std::vector<std::string> notes;
    std::vector<fs::path> stale;
    if (result_rows(experiment, results).empty()) return stale;
    for (const fs::path& file : write_report(experiment, results, made.path(), notes)) {
        const bool page = file.filename() == "README.md";
        if (page && !notes.empty()) continue; // without gnuplot it would lack its plots
        const fs::path there = folder / file.filename();
        const std::string now = base::read_text(file), before = fs::exists(there) ? base::read_text(there) : "";
        if (now == before || (file.extension() == ".svg" && !before.empty() && of_other_gnuplots(now, before))) continue;
        stale.push_back(there);
        if (!check) base::write_text(there, now);
    }
    return stale;
}

} // namespace

std::vector<fs::path> update_result_pages(const fs::path& root, bool check)
{
    std::vector<fs::path> stale;
    std::error_code none;
    for (const fs::directory_entry& device : fs::directory_iterator(root / "experiments" / "results", none))
        for (const fs::directory_entry& folder : fs::directory_iterator(device.path(), none)) {
            if (!fs::exists(folder.path() / "results.jsonl")) continue;
            const std::optional<fs::path> file = experiment_file(root, folder.path().filename().string());
            if (!file) continue;
            std::optional<Experiment> experiment;
            try {
                experiment = read_experiment(*file);
            } catch (const base::Error&) {
                continue; // its scenes are elsewhere; `gnomon sweep` says so
            }
            const std::vector<fs::path> own = update_sweep(folder.path(), *experiment, check);
            stale.insert(stale.end(), own.begin(), own.end());
        }
    std::sort(stale.begin(), stale.end());
    return stale;
}

} // namespace gnomon::lab
