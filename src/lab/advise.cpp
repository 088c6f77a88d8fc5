// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "base/progress.h"
#include "lab/goal.h"
#include "lab/meter.h"

#include <algorithm>
#include <cmath>

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
            base::fail("no technique could be measured: {}", out_.left_out.empty() ? "there is none" : out_.left_out.front());
        out_.reference_ms = rule.reference_ms();
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
        out_.scene = stage.scene_name, out_.camera = stage.camera.name, out_.light = meter_->light_name(full);
        out_.size = options_.stage.size, out_.metric = options_.metric, out_.budget = options_.budget;
        out_.device = device_.info().name, out_.driver = device_.info().driver, out_.commit = commit();
    }

    void collect()
    {
        const Stage& stage = meter_->stage(full);
        for (Candidate& c : find_candidates(device_, stage, out_.features, options_.prefer)) {
            const auto& without = options_.without;
            if (c.left_out.empty() && std::find(without.begin(), without.end(), c.choice.info->id) != without.end()) continue;
            if (c.left_out.empty())
                candidates_.push_back(std::move(c.choice));
            else
                out_.left_out.push_back(fmt::format("{}: {}", c.choice.info->id, c.left_out));
        }
        out_.candidates = candidates_.size();
        if (candidates_.empty())
            base::fail("no technique fits this light and preference{}",
                out_.left_out.empty() ? "" : "; the first that was left out is " + out_.left_out.front());
    }

    /// Settled ones apart.
    size_t expected() const
    {
        size_t count = options_.exhaustive ? candidates_.size() : 0;
        for (size_t left = candidates_.size(), round = 0; round < Rule::rounds;
             ++round, left = std::max(HalvingOptions().least, (left + 2) / 3))
            count += left;
        return count;
    }

    Gauges gauges(base::Progress& progress)
    {
        return {.measure = [this, &progress](size_t i, int round, const Again& again) { return measure(i, round, again, progress); },
            .time
            = [this](size_t i, const Again& again) { return meter_->measure_time(full, candidates_[i], 1, again).technique_least_ms; },
            .time_reference = [this](const Again& again) { return meter_->measure_time(full, reference_, 1, again).technique_least_ms; },
            .costs_more = [this](size_t a, size_t b) { return costs_more(candidates_[a], candidates_[b]); }};
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
            out_.left_out.push_back(fmt::format("{}: {}", choice_text(candidates_[candidate]), e.what()));
            return {};
        }
    }

    Measured measured(const Rule& rule, size_t i) const { return {candidates_[i], rule.reading(i), rule.excess(rule.reading(i))}; }

    void choose(const Rule& rule)
    {
        const std::vector<size_t>& last = rule.finalists();
        out_.finished = last.size();
        std::vector<Trial> trials;
        for (const size_t i : last) trials.push_back({rule.reading(i).error, rule.reading(i).ms, rule.excess(rule.reading(i))});
        for (const size_t i : pareto_front(trials)) out_.front.push_back(measured(rule, last[i]));
        out_.reasons = feature_sentences(out_.features);
        out_.reasons.push_back(
            fmt::format("{} settings of techniques that fit were measured, {} of them at the full {}x{}; {} were left out", out_.candidates,
                out_.finished, out_.size.width, out_.size.height, out_.left_out.size()));
        if (const std::optional<size_t> best = rule.chosen()) {
            out_.chosen = measured(rule, *best);
            explain(rule);
            return;
        }
        const Measured m = measured(rule, *std::min_element(last.begin(), last.end(), [&](size_t a, size_t b) {
            return rule.excess(rule.reading(a)) < rule.excess(rule.reading(b));
        }));
        out_.nothing
            = fmt::format("nothing that fits keeps the budget of {}{}: nearest comes {} with {:.4g} ms, {} and {} {:.4g}; allow that, or "
                          "take a smaller picture",
                fmt::join(out_.budget, " and "),
                out_.reference_ms > 0 ? fmt::format(" ({} takes {:.4g} ms)", options_.reference, out_.reference_ms) : "",
                choice_text(m.choice), m.reading.ms, quantity_text("bytes", double(m.reading.bytes)), out_.metric, m.reading.error);
    }

    void explain(const Rule& rule)
    {
        const Measured& best = *out_.chosen;
        const shadow::TechniqueInfo& info = *best.choice.info;
        const std::string within = out_.budget.empty() ? "" : fmt::format(" of those within {}", fmt::join(out_.budget, " and "));
        out_.reasons.push_back(fmt::format(
            "{} errs least{}: {} {:.4g} in {:.4g} ms", choice_text(best.choice), within, out_.metric, best.reading.error, best.reading.ms));
        if (info.exact) out_.reasons.push_back(fmt::format("{} is exact up to a band at true edges", info.id));
        if (out_.features.soft && !info.soft)
            out_.reasons.push_back(fmt::format("it takes the light as a point, and yet nothing soft that {} errs less",
                out_.budget.empty() ? "was measured" : "keeps the budget"));
        std::optional<Measured> other, over;
        for (const size_t i : rule.finalists()) {
            Measured m = measured(rule, i);
            const auto errs_less = [](const Measured& a, const Measured& b) { return a.reading.error < b.reading.error; };
            if (m.choice.info != best.choice.info && m.excess == 0 && (!other || errs_less(m, *other))) other = m;
            if (m.excess > 0 && errs_less(m, best) && (!over || m.excess < over->excess)) over = m;
        }
        if (other)
            out_.reasons.push_back(fmt::format("the next technique is {}: {} {:.4g} in {:.4g} ms", choice_text(other->choice), out_.metric,
                other->reading.error, other->reading.ms));
        if (over)
            out_.reasons.push_back(fmt::format("with more to spend there is {}: {} {:.4g} in {:.4g} ms and {}", choice_text(over->choice),
                out_.metric, over->reading.error, over->reading.ms, quantity_text("bytes", double(over->reading.bytes))));
    }

    void compare_with_best(const Rule& rule)
    {
        const std::optional<size_t> best = rule.best_of_all();
        if (!best) return;
        out_.best = measured(rule, *best);
        const double least = out_.best->reading.error;
        // both 0: nothing lost
        if (out_.chosen && out_.chosen->reading.error > least) out_.regret = missed_by(out_.chosen->reading.error, least);
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
