// SPDX-License-Identifier: Apache-2.0
#include "metrics/comparison.h"

#include <algorithm>

namespace gnomon::metrics {

namespace {

/// Mean over scored pixels of the difference's part above 0, its sign turned where asked.
double mean_above(const Comparison& c, double sign)
{
    const Grey g(c);
    double sum = 0.0;
    size_t scored = 0;
    for (size_t i = 0; i < g.size(); ++i) {
        if (!g.scored(i)) continue;
        ++scored;
        sum += std::max(0.0, sign * double(g.difference(i)));
    }
    return scored ? sum / double(scored) : 0.0;
}

double lighter(const Comparison& c) { return mean_above(c, 1.0); }
double darker(const Comparison& c) { return mean_above(c, -1.0); }

} // namespace

const std::vector<Metric>& filter_metrics()
{
    static const std::vector<Metric> all{
        {"filter_mae", "visibility", "mean absolute difference to the reference technique", true, true, mae},
        {"filter_rms", "visibility", "root of the mean squared difference", true, true, rms},
        {"filter_max", "visibility", "largest absolute difference", true, true, max_error},
        {"filter_bias", "visibility", "mean of test - reference: filter_leak - filter_dark", true, true, bias},
        {"filter_leak", "visibility", "mean of max(0, test - reference)", true, true, lighter},
        {"filter_dark", "visibility", "mean of max(0, reference - test)", true, true, darker},
    };
    return all;
}

std::map<std::string, double> measure_filter(const Comparison& c)
{
    std::map<std::string, double> result;
    for (const Metric& m : filter_metrics()) result.emplace(m.id, m.measure(c));
    return result;
}

} // namespace gnomon::metrics
