// SPDX-License-Identifier: Apache-2.0
#include "lab/advise.h"

#include "base/error.h"
#include "base/progress.h"
#include "lab/goal.h"
#include "lab/halving.h"
#include "lab/meter.h"

#include <algorithm>
#include <array>
#include <map>

namespace gnomon::lab {

namespace {

constexpr int rounds = 3; // at a quarter, half and all of the picture's sides

class Adviser {
public:
    Adviser(gpu::Device& device, const AdviseOptions& options)
        : device_(device)
        , options_(options)
        , errors_(parse_sum(options.metric))
        , reference_(parse_choice(options.reference))
    {
        for (const std::string& id : options.without) shadow::technique(id);
        for (const std::string& text : options.budget) budget_.push_back(parse_budget(text));
        for (const std::string& q : errors_)
            if (is_cost(q)) base::fail("{} is no error; --metric takes metrics, and --budget bounds time and memory", q);
    }

    Advice run()
    {
        open();
        collect();
        base::Progress progress("advise " + out_.scene, expected());
        progress_ = &progress;
        measure_reference();
        if (options_.exhaustive)
            for (size_t i = 0; i < candidates_.size(); ++i) trial(i, rounds - 1);
        const std::vector<size_t> last
            = halve({.candidates = candidates_.size(), .rounds = rounds, .measure = [this](size_t candidate, int round) {
                         return trial(candidate, round);
                     }});
        if (last.empty()) base::fail("no technique could be measured: {}", out_.left_out.empty() ? "there is none" : out_.left_out.front());
        choose(last);
        if (options_.exhaustive) compare_with_best();
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
        for (const int part : {4, 2, 1}) {
            StageOptions smaller = options_.stage;
            smaller.size = {std::max(smaller.size.width / part, 1), std::max(smaller.size.height / part, 1)};
            meter_->add(smaller);
        }
        out_.scene = stage.scene_name, out_.camera = stage.camera.name, out_.light = meter_->light_name(rounds - 1);
        out_.size = options_.stage.size, out_.metric = options_.metric, out_.budget = options_.budget;
        out_.device = device_.info().name, out_.driver = device_.info().driver, out_.commit = commit();
    }

    void collect()
    {
        const Stage& stage = meter_->stage(rounds - 1);
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

    size_t expected() const
    {
        size_t count = options_.exhaustive ? candidates_.size() : 0;
        for (size_t left = candidates_.size(), round = 0; round < rounds; ++round, left = std::max(HalvingOptions().least, (left + 1) / 2))
            count += left;
        return count;
    }

    /// At full size: times of small pictures may then be held against the same milliseconds, which no larger picture takes less of.
    void measure_reference()
    {
        if (std::none_of(budget_.begin(), budget_.end(), [](const Constraint& c) { return c.relative; })) return;
        const Run run = meter_->measure_time(rounds - 1, reference_, std::max(options_.repeats, 3));
        out_.reference_ms = run.technique_ms;
        for (Constraint& c : budget_)
            if (c.relative) c.limit *= quantity_of(run, c.quantity), c.relative = false;
    }

    std::optional<Trial> trial(size_t candidate, int round)
    {
        const auto key = std::pair(candidate, round);
        if (const auto found = seen_.find(key); found != seen_.end()) return found->second;
        std::optional<Trial>& out = seen_[key];
        progress_->advance();
        const Choice& choice = candidates_[candidate];
        if (too_dear(choice, round)) return out;
        try {
            const Run run = meter_->measure(size_t(round), choice, round == rounds - 1 ? options_.repeats : 2);
            Measured m{choice, 0, run.technique_ms, 0, run.bytes};
            for (const std::string& q : errors_) m.error += quantity_of(run, q);
            for (const Constraint& c : budget_) m.excess += missed_by(quantity_of(run, c.quantity), c.limit);
            out = Trial{m.error, m.ms, m.excess};
            if (round == rounds - 1) full_.insert_or_assign(candidate, std::move(m));
        } catch (const base::Error& e) {
            // as where a map is too large for the device; a metric that is not there is missing everywhere
            if (full_.empty() && seen_.size() == 1) throw;
            out_.left_out.push_back(fmt::format("{}: {}", choice_text(choice), e.what()));
        }
        return out;
    }

    /// With less of something it is far over the budget already: then it need not be measured.
    bool too_dear(const Choice& choice, int round) const
    {
        return std::any_of(seen_.begin(), seen_.end(), [&](const auto& entry) {
            const auto& [key, trial] = entry;
            return key.second == round && trial && trial->excess > 2 * HalvingOptions().slack && costs_more(choice, candidates_[key.first]);
        });
    }

    static bool less(const Measured& a, const Measured& b) { return a.error != b.error ? a.error < b.error : a.ms < b.ms; }

    /// The one within the budget that errs least; null where there is none.
    const Measured* least(const std::vector<size_t>& among) const
    {
        const Measured* out = nullptr;
        for (const size_t i : among) {
            const Measured& m = full_.at(i);
            if (m.excess == 0 && (!out || less(m, *out))) out = &m;
        }
        return out;
    }

    void choose(const std::vector<size_t>& last)
    {
        out_.finished = last.size();
        std::vector<Trial> trials;
        for (const size_t i : last) trials.push_back({full_.at(i).error, full_.at(i).ms, full_.at(i).excess});
        for (const size_t i : pareto_front(trials)) out_.front.push_back(full_.at(last[i]));
        out_.reasons = feature_sentences(out_.features);
        out_.reasons.push_back(
            fmt::format("{} settings of techniques that fit were measured, {} of them at the full {}x{}; {} were left out", out_.candidates,
                out_.finished, out_.size.width, out_.size.height, out_.left_out.size()));
        if (const Measured* best = least(last)) {
            out_.chosen = *best;
            explain(last);
            return;
        }
        const size_t near
            = *std::min_element(last.begin(), last.end(), [&](size_t a, size_t b) { return full_.at(a).excess < full_.at(b).excess; });
        const Measured& m = full_.at(near);
        out_.nothing
            = fmt::format("nothing that fits keeps the budget of {}{}: nearest comes {} with {:.4g} ms, {} and {} {:.4g}; allow that, or "
                          "take a smaller picture",
                fmt::join(out_.budget, " and "),
                out_.reference_ms > 0 ? fmt::format(" ({} takes {:.4g} ms)", options_.reference, out_.reference_ms) : "",
                choice_text(m.choice), m.ms, quantity_text("bytes", double(m.bytes)), out_.metric, m.error);
    }

    void explain(const std::vector<size_t>& last)
    {
        const Measured& best = *out_.chosen;
        const shadow::TechniqueInfo& info = *best.choice.info;
        const std::string within = out_.budget.empty() ? "" : fmt::format(" of those within {}", fmt::join(out_.budget, " and "));
        out_.reasons.push_back(
            fmt::format("{} errs least{}: {} {:.4g} in {:.4g} ms", choice_text(best.choice), within, out_.metric, best.error, best.ms));
        if (info.exact) out_.reasons.push_back(fmt::format("{} is exact up to a band at true edges", info.id));
        if (out_.features.soft && !info.soft)
            out_.reasons.push_back(fmt::format("it takes the light as a point, and yet nothing soft that {} errs less",
                out_.budget.empty() ? "was measured" : "keeps the budget"));
        const Measured *other = nullptr, *over = nullptr;
        for (const size_t i : last) {
            const Measured& m = full_.at(i);
            if (m.choice.info != best.choice.info && m.excess == 0 && (!other || less(m, *other))) other = &m;
            if (m.excess > 0 && m.error < best.error && (!over || m.excess < over->excess)) over = &m;
        }
        if (other)
            out_.reasons.push_back(fmt::format(
                "the next technique is {}: {} {:.4g} in {:.4g} ms", choice_text(other->choice), out_.metric, other->error, other->ms));
        if (over)
            out_.reasons.push_back(fmt::format("with more to spend there is {}: {} {:.4g} in {:.4g} ms and {}", choice_text(over->choice),
                out_.metric, over->error, over->ms, quantity_text("bytes", double(over->bytes))));
    }

    void compare_with_best()
    {
        std::vector<size_t> all;
        for (const auto& [i, m] : full_) all.push_back(i);
        const Measured* best = least(all);
        if (!best) return;
        out_.best = *best;
        // both 0: nothing lost
        if (out_.chosen && out_.chosen->error > best->error) out_.regret = missed_by(out_.chosen->error, best->error);
        if (!out_.chosen) out_.nothing += fmt::format(" (measuring all finds {})", choice_text(best->choice));
    }

    gpu::Device& device_;
    const AdviseOptions& options_;
    std::vector<std::string> errors_;
    Choice reference_;
    std::vector<Constraint> budget_;
    std::optional<Meter> meter_;
    std::vector<Choice> candidates_;
    std::map<std::pair<size_t, int>, std::optional<Trial>> seen_;
    std::map<size_t, Measured> full_; ///< by candidate
    base::Progress* progress_ = nullptr;
    Advice out_;
};

} // namespace

Advice advise(gpu::Device& device, const AdviseOptions& options) { return Adviser(device, options).run(); }

} // namespace gnomon::lab
