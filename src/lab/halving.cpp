// SPDX-License-Identifier: Apache-2.0
#include "lab/halving.h"

#include <algorithm>
#include <numeric>

namespace gnomon::lab {

namespace {

std::vector<size_t> counted(size_t count)
{
    std::vector<size_t> out(count);
    std::iota(out.begin(), out.end(), size_t(0));
    return out;
}

/// Indices into `trials`, front after front, each with its least error first.
std::vector<size_t> by_fronts(const std::vector<Trial>& trials)
{
    std::vector<size_t> left = counted(trials.size()), out;
    while (!left.empty()) {
        std::vector<Trial> present;
        for (const size_t i : left) present.push_back(trials[i]);
        std::vector<size_t> front = pareto_front(present);
        // the slow end of a front is the one with little error
        for (auto f = front.rbegin(); f != front.rend(); ++f) out.push_back(left[*f]);
        std::sort(front.rbegin(), front.rend());
        for (const size_t f : front) left.erase(left.begin() + long(f));
    }
    return out;
}

/// Some of the trials, the most promising first: alternately the least error and the foremost front.
std::vector<size_t> ranked(const std::vector<Trial>& trials, const std::vector<size_t>& some)
{
    std::vector<Trial> present;
    for (const size_t i : some) present.push_back(trials[i]);
    std::vector<size_t> errors = counted(present.size());
    std::stable_sort(errors.begin(), errors.end(), [&](size_t a, size_t b) { return present[a].error < present[b].error; });
    const std::vector<size_t> fronts = by_fronts(present);
    std::vector<bool> taken(present.size(), false);
    std::vector<size_t> out;
    for (size_t i = 0; i < present.size(); ++i)
        for (const size_t one : {errors[i], fronts[i]})
            if (!taken[one]) taken[one] = true, out.push_back(some[one]);
    return out;
}

/// The better `keep` of them, as indices into `trials`: two of those within the budget for each one that is a little over it, since what is
/// dearer mostly errs less and would crowd out the rest.
std::vector<size_t> chosen(const std::vector<Trial>& trials, size_t keep, double slack)
{
    std::vector<size_t> within, over, order = counted(trials.size());
    for (const size_t i : order)
        if (trials[i].excess <= slack) (trials[i].excess > 0 ? over : within).push_back(i);
    if (within.empty() && over.empty()) {
        std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return trials[a].excess < trials[b].excess; });
        order.resize(std::min(keep, order.size()));
        return order;
    }
    within = ranked(trials, within), over = ranked(trials, over);
    std::vector<size_t> out;
    for (size_t i = 0, j = 0; out.size() < keep && (i < within.size() || j < over.size());) {
        const bool next_within = i < within.size() && (j >= over.size() || i <= 2 * j + 1);
        out.push_back(next_within ? within[i++] : over[j++]);
    }
    return out;
}

} // namespace

std::vector<size_t> pareto_front(const std::vector<Trial>& trials)
{
    std::vector<size_t> order = counted(trials.size()), out;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return trials[a].time != trials[b].time ? trials[a].time < trials[b].time : trials[a].error < trials[b].error;
    });
    for (const size_t i : order)
        if (out.empty() || trials[i].error < trials[out.back()].error) out.push_back(i);
    return out;
}

std::vector<size_t> halve(const HalvingOptions& options)
{
    std::vector<size_t> left = counted(options.candidates);
    for (int round = 0; round < options.rounds; ++round) {
        std::vector<size_t> ran;
        std::vector<Trial> trials;
        for (const size_t candidate : left)
            if (const std::optional<Trial> trial = options.measure(candidate, round)) ran.push_back(candidate), trials.push_back(*trial);
        left = ran;
        if (round + 1 == options.rounds) break;
        std::vector<size_t> next;
        for (const size_t i : chosen(trials, std::max(options.least, (left.size() + 2) / 3), options.slack)) next.push_back(left[i]);
        std::sort(next.begin(), next.end());
        left = std::move(next);
    }
    return left;
}

} // namespace gnomon::lab
