// SPDX-License-Identifier: Apache-2.0
#include "lab/advise_rule.h"

#include "lab/goal.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

/// Over the budget by no more than this, a few more frames may show that it keeps it.
constexpr double near = 0.5;
/// Over it by more than this, none will.
constexpr double hopeless = 3.0;

} // namespace

Rule::Rule(size_t candidates, Budget budget, Gauges gauges, int frames)
    : candidates_(candidates)
    , budget_(budget)
    , gauges_(std::move(gauges))
    , frames_(frames)
{
}

/// More frames than others have, since all are held against it.
void Rule::time_reference()
{
    if (!std::isfinite(budget_.times)) return;
    const double ms = gauges_.time_reference([this](int frames, double) { return frames < 4 * frames_; });
    reference_ms_ = reference_ms_ > 0 ? std::min(reference_ms_, ms) : ms;
}

double Rule::limit_ms() const { return std::min(budget_.ms, std::isfinite(budget_.times) ? budget_.times * reference_ms_ : budget_.times); }

double Rule::excess(const Reading& r) const { return missed_by(r.ms, limit_ms()) + missed_by(double(r.bytes), budget_.bytes); }

/// Small pictures need no exact times, nor does what is far over the budget.
Again Rule::patience(int round) const
{
    const double limit = limit_ms(), most = (1 + hopeless) * limit;
    if (round + 1 < rounds) return [=](int frames, double least) { return frames < 2 && least > limit && least <= most; };
    return [=, some = frames_](int frames, double least) { return frames < some && least <= most; };
}

/// With less of something it is far over the budget already, in a picture that is no larger.
bool Rule::too_dear(size_t candidate, int round) const
{
    return std::any_of(seen_.begin(), seen_.end(), [&](const auto& entry) {
        const auto& [key, reading] = entry;
        return key.second <= round && reading && excess(*reading) > HalvingOptions().slack && gauges_.costs_more(candidate, key.first);
    });
}

std::optional<Trial> Rule::trial(size_t candidate, int round)
{
    const auto key = std::pair(candidate, round);
    if (seen_.find(key) == seen_.end()) {
        std::optional<Reading> reading;
        if (!too_dear(candidate, round))
            reading = gauges_.measure(candidate, round, patience(round));
        else if (gauges_.passed_over)
            gauges_.passed_over();
        if (reading && round + 1 == rounds) full_[candidate] = *reading;
        seen_[key] = reading;
    }
    const std::optional<Reading>& r = seen_.at(key);
    if (!r) return {};
    return Trial{r->error, r->ms, excess(*r)};
}

bool Rule::better(size_t a, size_t b) const
{
    const Reading &x = full_.at(a), &y = full_.at(b);
    return x.error != y.error ? x.error < y.error : x.ms < y.ms;
}

std::optional<size_t> Rule::least(const std::vector<size_t>& among) const
{
    std::optional<size_t> out;
    for (const size_t i : among)
        if (excess(full_.at(i)) == 0 && (!out || better(i, *out))) out = i;
    return out;
}

std::vector<size_t> Rule::measured() const
{
    std::vector<size_t> out;
    for (const auto& [i, reading] : full_) out.push_back(i);
    return out;
}

/// Those that err less than the best within the budget, and are over it by little, are timed again, the reference beside them: what made
/// them late may have been another program.
void Rule::settle(std::vector<size_t> among)
{
    const Again until_within = [this](int frames, double least) { return frames < 4 * frames_ && least > limit_ms(); };
    std::sort(among.begin(), among.end(), [this](size_t a, size_t b) { return better(a, b); });
    for (const size_t i : among) {
        Reading& r = full_.at(i);
        for (int pass = 0; pass < 3 && excess(r) > 0 && missed_by(r.ms, limit_ms()) <= near && double(r.bytes) <= budget_.bytes; ++pass) {
            r.ms = std::min(r.ms, gauges_.time(i, until_within));
            time_reference();
        }
        if (excess(r) == 0) return;
    }
}

void Rule::measure_all()
{
    time_reference();
    for (size_t i = 0; i < candidates_; ++i) trial(i, rounds - 1);
    settle(measured());
}

void Rule::run()
{
    time_reference();
    finalists_ = halve(
        {.candidates = candidates_, .rounds = rounds, .measure = [this](size_t candidate, int round) { return trial(candidate, round); }});
    time_reference();
    settle(finalists_);
}

} // namespace gnomon::lab
