// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "base/progress.h"
#include "lab/goal.h"
#include "lab/meter.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::lab {

namespace {

constexpr size_t full = size_t(Rule::rounds - 1); // the place of the whole picture

// Of the picture's sides; the first round's picture has a part of this, but enough pixels to tell settings apart.
constexpr double least_part = 0.25, least_pixels = 3600;

class Adviser {
public:
    Adviser(gpu::Device& device, const AdviseOptions& options)
        : device_(device)
        , options_(options)
        , errors_(parse_sum(options.metric))
        , reference_(parse_choice(options.reference))
    {
        for (const std::string& id : options.without) shadow::technique(id);
        for (const std::string& text : options.budget) {
            const Constraint c = parse_budget(text);
            double& bound = c.quantity == "bytes" ? budget_.bytes : c.relative ? budget_.times : budget_.ms;
            bound = std::min(bound, c.limit);
        }
        for (const std::string& q : errors_)
            if (is_cost(q)) base::fail("{} is no error; --metric takes metrics, and --budget bounds time and memory", q);
    }

    Advice run()
    {
        open();
        collect();
        base::Progress progress("advise " + out_.scene, expected());
        Rule rule(candidates_.size(), budget_, gauges(progress), options_.repeats);
        if (options_.exhaustive) rule.measure_all();
        rule.run();
        if (rule.finalists().empty())
            base::fail("no technique could be measured: {}", out_.left_out.empty() ? "all take far too long" : out_.left_out.back().why);
        choose(rule);
        if (options_.exhaustive) compare_with_best(rule);
        return std::move(out_);
    }

private:
    void open()
    {
        const Stage stage = open_stage(options_.stage);
        Features& f = out_.features;
        f = find_features(stage, options_.stage);
        std::optional<truth::Quantity> quantity;
        if (f.see_through) quantity = truth::Quantity::transmittance;
        meter_.emplace(device_, MeterSettings{options_.truth_samples, {}, quantity, options_.truth_cache});
        const base::Size size = options_.stage.size;
        const double smallest = std::min(1.0, std::max(least_part, std::sqrt(least_pixels / double(size.area()))));
        for (const double part : {smallest, std::sqrt(smallest), 1.0}) {
            StageOptions smaller = options_.stage;
            const auto side = [&](int whole) { return std::max(int(std::lround(part * whole)), 1); };
            smaller.size = {side(size.width), side(size.height)};
            meter_->add(smaller);
        }
        const std::string refused = shadow::refusal(*reference_.info, device_, stage.lights.front());
        if (std::isfinite(budget_.times) && !refused.empty())
            base::fail("a budget in times is held against a reference, and {}; name one that does with --reference", refused);
        out_.scene = stage.scene_name, out_.camera = stage.camera.name, out_.light = meter_->light_name(full);
        out_.size = options_.stage.size, out_.metric = options_.metric, out_.reference = options_.reference, out_.budget = options_.budget;
        out_.device = device_.info().name, out_.driver = device_.info().driver, out_.commit = commit();
    }

    void collect()
    {
        const auto& without = options_.without;
        std::set<const shadow::TechniqueInfo*> techniques;
        for (Candidate& c : find_candidates(device_, meter_->stage(full), out_.features, options_.prefer)) {
            if (std::find(without.begin(), without.end(), c.choice.info->id) != without.end()) continue;
            if (!c.left_out.empty()) {
                out_.left_out.push_back({std::string(c.choice.info->id), c.left_out});
                continue;
            }
            techniques.insert(c.choice.info);
            candidates_.push_back(std::move(c.choice));
        }
        out_.candidates = candidates_.size(), out_.techniques = techniques.size();
        if (candidates_.empty())
            base::fail("no technique fits this light, --prefer and --without; {}",
                out_.left_out.empty() ? "--without names them all"
                                      : fmt::format("{} is left out because {}", out_.left_out.front().what, out_.left_out.front().why));
    }

    /// Readings at most, those included that are passed over. Exhaustive, all at full size come first, and the last round makes no more.
    size_t expected() const
    {
        size_t count = 0, left = candidates_.size();
        for (int round = 0; round < Rule::rounds; ++round, left = std::min(left, std::max(HalvingOptions().least, (left + 2) / 3)))
            count += options_.exhaustive && size_t(round) == full ? candidates_.size() : left;
        return count;
    }

    Gauges gauges(base::Progress& progress)
    {
        return {.measure = [this, &progress](size_t i, int round, const Again& again) { return measure(i, round, again, progress); },
            .time
            = [this](size_t i, const Again& again) { return meter_->measure_time(full, candidates_[i], 1, again).technique_least_ms; },
            .time_reference = [this](const Again& again) { return meter_->measure_time(full, reference_, 1, again).technique_least_ms; },
            .costs_more = [this](size_t a, size_t b) { return costs_more(candidates_[a], candidates_[b]); },
            .passed_over = [&progress] { progress.advance(); }};
    }

    std::optional<Reading> measure(size_t candidate, int round, const Again& again, base::Progress& progress)
    {
        progress.advance();
        try {
            const Run run = meter_->measure(size_t(round), candidates_[candidate], 1, again);
            Reading out{
                .ms = run.technique_least_ms, .mean_ms = run.technique_ms, .deviation_ms = run.technique_deviation, .bytes = run.bytes};
            for (const std::string& q : errors_) out.error += quantity_of(run, q);
            measured_one_ = true;
            return out;
        } catch (const base::Error& e) {
            // as where a map is too large for the device; a metric that is not there is missing everywhere
            if (!measured_one_) throw;
            out_.left_out.push_back({choice_text(candidates_[candidate]), e.what()});
            return {};
        }
    }

    Measured measured(const Rule& rule, size_t i) const { return {candidates_[i], rule.reading(i), rule.excess(rule.reading(i))}; }

    void choose(const Rule& rule)
    {
        std::vector<Trial> trials;
        for (const size_t i : rule.finalists()) {
            out_.measured.push_back(measured(rule, i));
            trials.push_back({rule.reading(i).error, rule.reading(i).ms, out_.measured.back().excess});
        }
        for (const size_t i : pareto_front(trials)) out_.front.push_back(out_.measured[i]);
        out_.reference_ms = rule.reference_ms();
        if (const std::optional<size_t> best = rule.chosen())
            out_.chosen = measured(rule, *best);
        else
            out_.nothing = nothing_keeps(out_);
        out_.reasons = advice_reasons(out_);
    }

    void compare_with_best(const Rule& rule)
    {
        const std::optional<size_t> best = rule.best_of_all();
        if (!best) return;
        out_.best = measured(rule, *best);
        // a picture tells no errors apart that are less than one wrong pixel
        const double least = std::max(out_.best->reading.error, 1.0 / double(out_.size.area()));
        if (out_.chosen) out_.regret = missed_by(out_.chosen->reading.error, least);
        if (!out_.chosen) out_.nothing += fmt::format(" (measuring all finds {})", choice_text(out_.best->choice));
    }

    gpu::Device& device_;
    const AdviseOptions& options_;
    std::vector<std::string> errors_;
    Choice reference_;
    Budget budget_;
    std::optional<Meter> meter_;
    std::vector<Choice> candidates_;
    bool measured_one_ = false;
    Advice out_;
};

} // namespace

Advice advise(gpu::Device& device, const AdviseOptions& options) { return Adviser(device, options).run(); }

} // namespace gnomon::lab
