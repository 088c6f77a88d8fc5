// SPDX-License-Identifier: Apache-2.0
#include "metrics/comparison.h"

#include <algorithm>
#include <cmath>

namespace gnomon::metrics {

namespace {

/// Mean of `value(grey, pixel)` over scored pixels that `chosen` takes; 0 if there are none.
template <class Chosen, class Value> double mean_where(const Comparison& c, Chosen chosen, Value value)
{
    const Grey g(c);
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < g.size(); ++i) {
        if (!g.scored(i) || !chosen(g, i)) continue;
        sum += value(g, i);
        ++count;
    }
    return count ? sum / double(count) : 0.0;
}

bool every(const Grey&, size_t) { return true; }

bool penumbra(const Grey& g, size_t i) { return g.truth(i) > fully_dark && g.truth(i) < fully_lit; }

double difference(const Grey& g, size_t i) { return double(g.difference(i)); }

} // namespace

double mae(const Comparison& c)
{
    return mean_where(c, every, [](const Grey& g, size_t i) { return g.error(i).mean; });
}

double rms(const Comparison& c)
{
    return std::sqrt(mean_where(c, every, [](const Grey& g, size_t i) { return g.error(i).square; }));
}

double max_error(const Comparison& c)
{
    double largest = 0.0;
    mean_where(c, every, [&](const Grey& g, size_t i) { return largest = std::max(largest, g.error(i).largest); });
    return largest;
}

double bias(const Comparison& c) { return mean_where(c, every, difference); }

double bias_penumbra(const Comparison& c) { return mean_where(c, penumbra, difference); }

double bias_outside(const Comparison& c)
{
    return mean_where(
        c, [](const Grey& g, size_t i) { return !penumbra(g, i); }, difference);
}

double noise(const Comparison& c)
{
    return std::sqrt(mean_where(c, every, [](const Grey& g, size_t i) { return double(g.variance(i)); }));
}

} // namespace gnomon::metrics
