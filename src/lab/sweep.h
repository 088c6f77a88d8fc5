// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/experiment.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

// The runs of an experiment, their results file, and what is made of it. docs/experiments.md describes all three.
namespace gnomon::lab {

/// What a result was made with.
struct Provenance {
    std::string device, driver, processor, version, commit;
};
Provenance provenance(const gpu::Device&);

/// Finished runs by key. Of two lines with one key the later counts.
class Results {
public:
    /// Throws base::Error where the line is no result.
    void add(const std::string& line, const std::filesystem::path& file, size_t number);
    void add_file(const std::filesystem::path&, const std::vector<std::string>& lines);
    const nlohmann::ordered_json* find(const std::string& key) const;
    const std::map<std::string, nlohmann::ordered_json>& all() const { return lines_; }
    /// Throws base::Error where any result was made by another device or driver: times of two devices are never in one file.
    void demand_device(const std::string& device, const std::string& driver, const std::filesystem::path& file) const;

private:
    std::map<std::string, nlohmann::ordered_json> lines_;
};

struct SweepOptions {
    std::filesystem::path folder;
    int shard = 1, shards = 1; ///< this one of so many equal parts
    bool again = false; ///< measure finished runs anew
    std::filesystem::path truth_cache; ///< empty = the user's cache
};

struct SweepReport {
    std::filesystem::path results;
    size_t runs = 0, made = 0, skipped = 0; ///< of this shard; skipped: refused by the technique, with the reason as its result
    std::vector<std::filesystem::path> files; ///< tables, plots, page
    std::vector<std::string> notes; ///< what a reader should know, a sentence each
};

/// Makes the runs that the results file lacks, in order, each appended when it is finished; then, unless it is one shard of several,
/// the tables and plots. Throws base::Error; what was finished before stays.
SweepReport sweep(gpu::Device&, const Experiment&, const SweepOptions&);

/// Puts shards' files into folder/results.jsonl, with what is there already, and makes tables and plots. Throws base::Error where runs
/// are missing or two files hold different results of one run; then nothing is written.
SweepReport merge(const Experiment&, const std::vector<std::filesystem::path>& files, const std::filesystem::path& folder);

/// The different runs in order: combinations with one key are one run.
std::vector<const Cell*> distinct_runs(const Experiment&);
std::string cell_name(const Experiment&, const Cell&); ///< for people: technique, scene, and so on

/// experiments/results/<device>/<experiment> in the checkout.
std::filesystem::path default_results_folder(const std::string& device, const Experiment&);

/// One combination with its result.
struct Row {
    const Cell* cell;
    const nlohmann::ordered_json* line;
    std::optional<double> number(const std::string& column) const; ///< number_columns(); none where it was not measured
};
/// Rows that agree in some columns, in the order of the first of each.
struct RowGroup {
    std::vector<std::string> key; ///< the texts of those columns
    std::vector<Row> rows;
    std::optional<double> mean(const std::string& column) const;
};
std::vector<Row> result_rows(const Experiment&, const Results&);
std::vector<RowGroup> grouped(const std::vector<Row>&, const std::vector<std::string>& columns, const Where&);

/// results.csv, README.md and a .svg for each plot; returns the files. What could not be plotted is a sentence in `notes`.
std::vector<std::filesystem::path> write_report(
    const Experiment&, const Results&, const std::filesystem::path& folder, std::vector<std::string>& notes);
/// One plot by gnuplot: "" or, in a sentence, why there is none.
std::string draw_plot(const PlotSpec&, const std::vector<Row>&, const std::filesystem::path& file);

} // namespace gnomon::lab
