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

/// The better `keep` of them, as indices into `trials`.
std::vector<size_t> chosen(const std::vector<Trial>& trials, size_t keep, double slack)
{
    std::vector<size_t> order = counted(trials.size());
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return trials[a].excess < trials[b].excess; });
    const auto over = std::find_if(order.begin(), order.end(), [&](size_t i) { return trials[i].excess > slack; });
    if (over == order.begin()) {
        order.resize(std::min(keep, order.size()));
        return order;
    }
    order.erase(over, order.end());
    std::sort(order.begin(), order.end());
    if (order.size() <= keep) return order;
    std::vector<Trial> within;
    for (const size_t i : order) within.push_back(trials[i]);
    std::vector<size_t> errors = counted(within.size());
    std::stable_sort(errors.begin(), errors.end(), [&](size_t a, size_t b) { return within[a].error < within[b].error; });
    const std::vector<size_t> fronts = by_fronts(within);
    std::vector<bool> taken(within.size(), false);
    std::vector<size_t> out;
    for (size_t i = 0; out.size() < keep; ++i)
        for (const size_t one : {errors[i], fronts[i]})
            if (!taken[one] && out.size() < keep) taken[one] = true, out.push_back(order[one]);
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
        for (const size_t i : chosen(trials, std::max(options.least, (left.size() + 1) / 2), options.slack)) next.push_back(left[i]);
        std::sort(next.begin(), next.end());
        left = std::move(next);
    }
    return left;
}

} // namespace gnomon::lab
