// SPDX-License-Identifier: Apache-2.0
#include "lab/sweep.h"

#include "base/error.h"
#include "base/line_file.h"
#include "base/progress.h"
#include "lab/compare.h"
#include "lab/experiment_expand.h"
#include "lab/sequence.h"
#include "metrics/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

/// Makes runs one by one; keeps the scene, the truth and the reference images while they stay the same.
class Runner {
public:
    Runner(gpu::Device& device, const Experiment& experiment, const fs::path& truth_cache)
        : device_(device)
        , experiment_(experiment)
        , truth_cache_(truth_cache)
    {
    }

    Run run(const Cell& cell)
    {
        aim(cell);
        const scene::Light& light = stage_.lights.front();
        Run out = new_run(stage_, cell.choice, cell.columns.at("light"));
        out.camera = cell.columns.at("camera");
        out.skipped = unmeasurable(cell.choice, device_, light);
        if (!out.skipped.empty()) return out;
        Judge& judge = judge_of(truth_quantity(cell.choice));
        const Rendered rendered = render(device_, *scene_, stage_, cell.choice,
            {.repeats = experiment_.repeats,
                .warm_up = experiment_.warm_up,
                .frame_index = experiment_.frame_index,
                .count = true,
                .lit = experiment_.flip,
                .aovs = scored_aovs});
        score(stage_, light, judge.truth, rendered, out,
            {.filter = cell.reference ? &reference_of(*cell.reference) : nullptr, .edge_band = &judge.edge_band});
        if (experiment_.flip) {
            if (judge.lit.empty()) judge.lit = display(shade_with(device_, *scene_, stage_, {judge.truth.visibility.mean}, {}), stage_);
            out.metrics["flip"] = metrics::flip(display(rendered.radiance, stage_), judge.lit);
        }
        add_times(out, rendered);
        if (!cell.motion.empty()) sequence_of(cell).measure(cell.choice, out);
        return out;
    }

private:
    struct Judge {
        truth::Reference truth;
        std::vector<uint8_t> edge_band;
        base::Picture lit;
    };

    void aim(const Cell& cell)
    {
        if (stage_text(cell) == aimed_) return;
        judges_.clear(), references_.clear(), sequences_.clear();
        if (scene_text(cell) != opened_) {
            scene_.reset();
            stage_ = open_stage(cell.stage);
            scene_.emplace(device_, stage_.scene);
            opened_ = scene_text(cell);
        }
        aim_stage(stage_, cell.stage);
        stage_.lights.resize(1);
        aimed_ = stage_text(cell);
    }

    Judge& judge_of(truth::Quantity quantity)
    {
        const auto [found, fresh] = judges_.try_emplace(quantity);
        if (fresh)
            found->second.truth = truth::reference(
                stage_.scene, stage_.view, stage_.lights.front(), {.samples = experiment_.truth_samples}, quantity, truth_cache_);
        return found->second;
    }

    Sequence& sequence_of(const Cell& cell)
    {
        const auto found = sequences_.find(cell.motion);
        if (found != sequences_.end()) return found->second;
        return sequences_
            .emplace(cell.motion,
                Sequence(device_, *scene_, stage_, cell.stage, parse_motion(cell.motion),
                    {experiment_.truth_samples, experiment_.frame_index, truth_cache_}))
            .first->second;
    }

    const FilterReference& reference_of(const Choice& choice)
    {
        const std::string text = choice_text(choice);
        const auto found = references_.find(text);
        return found != references_.end() ? found->second : references_[text] = filter_reference(device_, *scene_, stage_, text);
    }

    gpu::Device& device_;
    const Experiment& experiment_;
    const fs::path truth_cache_;
    Stage stage_;
    std::optional<shadow::SceneGpu> scene_;
    std::string opened_, aimed_;
    std::map<truth::Quantity, Judge> judges_;
    std::map<std::string, FilterReference> references_;
    std::map<std::string, Sequence> sequences_; ///< by motion
};

Json result_line(const Experiment& experiment, const Cell& cell, const Run& run, const Provenance& made)
{
    Json line = {{"format", 1}, {"key", cell.key}, {"experiment", experiment.name}};
    line.update(run_json(run));
    line.update(Json{{"warm_up", experiment.warm_up}, {"repeats", experiment.repeats}, {"device", made.device}, {"driver", made.driver},
        {"processor", made.processor}, {"gnomon", made.version}, {"commit", made.commit}});
    return line;
}

void add_notes(SweepReport& report, const std::vector<const Cell*>& runs, const Results& results, const std::string& own_commit)
{
    std::set<std::string> known, commits;
    size_t other = 0;
    for (const Cell* cell : runs) {
        known.insert(cell->key);
        const Json* line = results.find(cell->key);
        if (!line) continue;
        report.skipped += line->contains("skipped");
        if (line->at("commit") == own_commit) continue;
        ++other, commits.insert(line->at("commit").get<std::string>());
    }
    if (other)
        report.notes.push_back(fmt::format("{} finished runs were made at another commit than {} ({}) and kept; --again measures them anew",
            other, own_commit, fmt::join(commits, ", ")));
    size_t strange = 0;
    for (const auto& [key, line] : results.all()) strange += !known.count(key);
    if (strange)
        report.notes.push_back(
            fmt::format("{} results in {} belong to no run here, as after a change of the experiment; they are kept and not shown", strange,
                report.results.string()));
}

} // namespace

SweepReport sweep(gpu::Device& device, const Experiment& experiment, const SweepOptions& options)
{
    if (options.shards < 1 || options.shard < 1 || options.shard > options.shards)
        base::fail("there is no shard {} of {}; they count from 1", options.shard, options.shards);
    const Provenance made = provenance(device);
    SweepReport report;
    report.results = options.folder
        / (options.shards == 1 ? std::string("results.jsonl") : fmt::format("results.{}-of-{}.jsonl", options.shard, options.shards));
    base::LineFile file(report.results);
    Results results;
    results.add_file(report.results, file.lines());
    results.demand_device(made.device, made.driver, report.results);

    std::vector<const Cell*> runs = distinct_runs(experiment), pending;
    // contiguous parts, so that few shards make the same truth
    const size_t begin = runs.size() * size_t(options.shard - 1) / size_t(options.shards);
    runs = {runs.begin() + long(begin), runs.begin() + long(runs.size() * size_t(options.shard) / size_t(options.shards))};
    std::copy_if(
        runs.begin(), runs.end(), std::back_inserter(pending), [&](const Cell* c) { return options.again || !results.find(c->key); });
    report.runs = runs.size();

    Runner runner(device, experiment, options.truth_cache);
    base::Progress progress("sweep " + experiment.name, pending.size());
    for (const Cell* cell : pending) {
        try {
            const std::string line = result_line(experiment, *cell, runner.run(*cell), made).dump();
            file.append(line);
            results.add(line, report.results, 0);
        } catch (const base::Error& e) {
            base::fail("run {} of {} ({}) failed: {}; what was finished is kept, and the same command goes on from there", report.made + 1,
                pending.size(), cell_name(experiment, *cell), e.what());
        }
        ++report.made;
        progress.advance();
    }
    add_notes(report, runs, results, made.commit);
    if (options.shards == 1) report.files = write_report(experiment, results, options.folder, report.notes);
    return report;
}

} // namespace gnomon::lab
