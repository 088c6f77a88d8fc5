// SPDX-License-Identifier: Apache-2.0
#include "lab/tune.h"

#include "base/error.h"
#include "base/progress.h"
#include "lab/search_space.h"
#include "lab/tune_runs.h"

#include <algorithm>
#include <optional>

namespace gnomon::lab {

namespace {

class Tuner {
public:
    Tuner(gpu::Device& device, const TuneOptions& options)
        : device_(device)
        , options_(options)
        , base_(parse_choice(options.technique))
        , meter_(device, {.truth_samples = options.truth_samples, .reference = options.reference, .truth_cache = options.truth_cache})
        , terms_(parse_terms(options.minimise))
        , under_(constraints(options))
        , vary_(varied())
        , space_(base_.params, vary_)
    {
        if (options.preset.extension() != ".json") base::fail("'{}' is no .json file; name the preset so", options.preset.string());
        if (options.budget < 1) base::fail("a budget of {} evaluations allows none; take at least 1", options.budget);
        if (options.tuning.empty())
            base::fail("no scene to tune on; name scene files that say \"tuning\": true, as experiments/tuning/*.json");
        for (const StageOptions& stage : options.tuning) add(stage, true);
        tuning_places_ = meter_.places();
        for (const StageOptions& stage : options.validation) add(stage, false);
        runs_.emplace(device, meter_, base_, TuneRuns::Goal{terms_, under_, options.reference},
            std::filesystem::path(options.preset).replace_extension(".runs.jsonl"));
    }

    Tuned run()
    {
        const Point start = space_.point(base_.params);
        base::Progress progress(
            "tune " + std::string(base_.info->id), size_t(options_.budget) * tuning_places_ + meter_.places() - tuning_places_);
        progress_ = &progress;
        const SearchResult found = search({.axes = space_.axes(),
            .start = start,
            .places = tuning_places_,
            .budget = size_t(options_.budget),
            .seed = options_.seed,
            .measure = [this, &start](const Point& p, size_t place) { return read(p, place, p == start); },
            .improved =
                [this](const Point& p, const Reading& r) {
                    if (r.violation > 0) return;
                    incumbents_.push_back(p);
                    if (options_.validation.empty()) write_preset(options_.preset, preset(p));
                }});
        if (found.reading.violation > 0) refuse(found);
        Tuned out{preset(found.best), better(found.reading, found.start), true, 0, 0};
        if (!options_.validation.empty()) validate(start, out);
        if (out.written) write_preset(options_.preset, out.preset);
        out.measured = runs_->measured(), out.kept = runs_->from_file();
        return out;
    }

private:
    static std::vector<Constraint> constraints(const TuneOptions& options)
    {
        std::vector<Constraint> out;
        for (const std::string& text : options.under) out.push_back(parse_constraint(text));
        return out;
    }

    std::vector<std::string> varied() const
    {
        if (!options_.vary.empty()) return options_.vary;
        std::vector<std::string> out;
        const std::vector<std::string> held = set_names(options_.technique);
        for (const shadow::ParamInfo& f : base_.params.table().fields)
            if (std::find(held.begin(), held.end(), f.name) == held.end()) out.push_back(f.name);
        if (out.empty()) base::fail("{} has no parameter to tune: it has none, or all are set", options_.technique);
        return out;
    }

    void add(StageOptions stage, bool tuning)
    {
        stage.kinds = base_.info->lights;
        const size_t place = meter_.add(stage);
        const Stage& opened = meter_.stage(place);
        if (tuning && !opened.scene.tuning)
            base::fail("{} may not be tuned on: it is a scene of published tables; a scene file with \"tuning\": true may "
                       "(docs/scene-files.md), or give it to --validate",
                stage.scene);
        if (!tuning && (opened.scene.tuning || !opened.scene.validation))
            base::fail("{} may not decide what is kept: it is a scene {}; validate on scene files with \"validation\": true, as "
                       "experiments/validation/*.json",
                stage.scene, opened.scene.tuning ? "for tuning" : "of published tables");
        if (const std::string reason = unmeasurable(base_, device_, opened.lights.front()); !reason.empty()) base::fail("{}", reason);
    }

    double sum(const std::vector<std::string>& term, const TuneRuns::Kept& kept) const
    {
        double out = 0;
        for (const std::string& q : term) out += is_cost(q) ? TuneRuns::ratio(kept.values.at(q), kept.reference.at(q)) : kept.values.at(q);
        return out;
    }

    /// As parts of what the start errs there, so that no scene outweighs the others. Both get an addend, a thousandth of the picture's
    /// pixels: what errs less is all right, and ratios of a few pixels are noise.
    std::vector<double> ratios_of(const TuneRuns::Kept& now, const TuneRuns::Kept& start) const
    {
        constexpr double few = 1e-3;
        std::vector<double> out;
        for (const std::vector<std::string>& term : terms_) out.push_back((sum(term, now) + few) / (sum(term, start) + few));
        return out;
    }

    Reading read(const Point& point, size_t place, bool start)
    {
        const TuneRuns::Kept& k = runs_->at({base_.info, space_.params(point)}, place, start);
        progress_->advance();
        if (k.values.empty()) return {0, 1e6};
        Reading out;
        for (const Constraint& c : under_)
            if (k.values.count(c.quantity)) out.violation += TuneRuns::missed(c, k);
        if (std::any_of(terms_.begin(), terms_.end(), [&](const auto& term) { return !k.values.count(term.front()); })) return out;
        for (const double r : ratios_of(k, runs_->at(base_, place, true))) out.value += r / double(terms_.size());
        return out;
    }

    std::vector<Preset::Place> places(const Choice& after, size_t from, size_t to)
    {
        std::vector<Preset::Place> out;
        for (size_t i = from; i < to; ++i) {
            const TuneRuns::Kept before = runs_->at(base_, i, true), now = runs_->at(after, i, false);
            const Stage& stage = meter_.stage(i);
            Preset::Place place{
                stage.scene_name, stage.camera.name, meter_.light_name(i), stage.view.size, {}, {}, ratios_of(now, before), 0};
            for (const std::vector<std::string>& term : terms_)
                for (const std::string& q : term) place.before[q] = before.values.at(q), place.after[q] = now.values.at(q);
            if (now.reference.count("time")) place.time_ratio = TuneRuns::ratio(now.values.at("time"), now.reference.at("time"));
            out.push_back(place);
        }
        return out;
    }

    /// Early stopping: of the settings that were the best in turn and gain in validation, the one that errs least there. The later ones
    /// fit the scenes of the search more closely, and others not always. Where none gains, the one that errs least.
    void validate(const Point& start, Tuned& out)
    {
        std::optional<std::pair<bool, double>> best; // no gain, and the ratio
        for (size_t i = tuning_places_; i < meter_.places(); ++i) read(start, i, true);
        for (const Point& point : incumbents_) {
            double violation = 0;
            for (size_t i = tuning_places_; i < meter_.places(); ++i) violation += read(point, i, false).violation;
            if (violation > 0) continue;
            Preset now = preset(point);
            now.validation = places(now.choice, tuning_places_, meter_.places());
            const Ratios found = ratios(now.validation);
            if (const std::pair rank{!found.gained(), found.mean}; !best || rank < *best) best = rank, out.preset = std::move(now);
        }
        out.written = best && !best->first;
    }

    Preset preset(const Point& point)
    {
        Preset out{.choice = {base_.info, space_.params(point)}, .vary = vary_, .minimise = options_.minimise, .under = options_.under};
        out.reference = options_.reference;
        out.tuning = places(out.choice, 0, tuning_places_);
        out.evaluations = size_t(options_.budget), out.seed = options_.seed;
        out.device = device_.info().name, out.driver = device_.info().driver, out.commit = commit();
        return out;
    }

    [[noreturn]] void refuse(const SearchResult& found)
    {
        const Choice nearest{base_.info, space_.params(found.best)};
        std::string misses;
        for (const Constraint& c : under_)
            for (size_t i = 0; i < tuning_places_; ++i) {
                const TuneRuns::Kept k = runs_->at(nearest, i, false);
                if (!k.values.count(c.quantity) || TuneRuns::missed(c, k) == 0) continue;
                misses += fmt::format("{}{} is {} in {}", misses.empty() ? "" : "; ", c.quantity,
                    quantity_text(c.quantity, k.values.at(c.quantity)), meter_.stage(i).scene_name);
                break;
            }
        base::fail("no setting of {} that was tried keeps {}: nearest comes {}, where {}; allow more, or search longer with --budget",
            base_.info->id, fmt::join(options_.under, " and "), choice_text(nearest), misses);
    }

    gpu::Device& device_;
    const TuneOptions& options_;
    Choice base_;
    Meter meter_;
    std::vector<std::vector<std::string>> terms_;
    std::vector<Constraint> under_;
    std::vector<std::string> vary_;
    SearchSpace space_;
    size_t tuning_places_ = 0;
    std::vector<Point> incumbents_; ///< those that were the best in turn and keep all bounds
    std::optional<TuneRuns> runs_;
    base::Progress* progress_ = nullptr;
};

} // namespace

Tuned tune(gpu::Device& device, const TuneOptions& options) { return Tuner(device, options).run(); }

} // namespace gnomon::lab
