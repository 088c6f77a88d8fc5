// SPDX-License-Identifier: Apache-2.0
#include "metrics/comparison.h"

#include <algorithm>
#include <cmath>

namespace gnomon::metrics {

namespace {

/// Fraction of scored pixels with `fault(grey, pixel)`.
template <class Fault> double fraction(const Comparison& c, Fault fault)
{
    const Grey g(c);
    size_t scored = 0, found = 0;
    for (size_t i = 0; i < g.size(); ++i) {
        if (!g.scored(i)) continue;
        ++scored;
        found += fault(g, i) ? 1 : 0;
    }
    return scored ? double(found) / double(scored) : 0.0;
}

bool wrong(const Grey& g, size_t i) { return std::abs(g.difference(i)) > 0.5f; }

/// Whether all scored pixels of the 3x3 neighbourhood are on one side. Pixels that are not scored show other surfaces, whose
/// shadows are no excuse for this one.
bool no_edge_near(const Grey& g, base::Size size, size_t i)
{
    const int x = int(i % size_t(size.width)), y = int(i / size_t(size.width));
    for (int v = std::max(0, y - 1); v <= std::min(size.height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(size.width - 1, x + 1); ++u) {
            const size_t j = size_t(v) * size_t(size.width) + size_t(u);
            if (g.scored(j) && (g.truth(j) > 0.5f) != (g.truth(i) > 0.5f)) return false;
        }
    return true;
}

} // namespace

double wrong_pixels(const Comparison& c) { return fraction(c, wrong); }

double acne(const Comparison& c)
{
    if (c.hard) return fraction(c, [](const Grey& g, size_t i) { return wrong(g, i) && g.difference(i) < 0.0f; });
    return fraction(c, [](const Grey& g, size_t i) { return g.truth(i) >= fully_lit && g.test(i) < 0.9f; });
}

double leak(const Comparison& c)
{
    if (c.hard) return fraction(c, [](const Grey& g, size_t i) { return wrong(g, i) && g.difference(i) > 0.0f; });
    return fraction(c, [](const Grey& g, size_t i) { return g.truth(i) <= fully_dark && g.test(i) > 0.1f; });
}

double wrong_outside_band(const Comparison& c)
{
    return fraction(c, [&](const Grey& g, size_t i) { return wrong(g, i) && no_edge_near(g, c.truth.size, i); });
}

double acne_outside_band(const Comparison& c)
{
    return fraction(c, [&](const Grey& g, size_t i) { return wrong(g, i) && g.difference(i) < 0.0f && no_edge_near(g, c.truth.size, i); });
}

double leak_outside_band(const Comparison& c)
{
    return fraction(c, [&](const Grey& g, size_t i) { return wrong(g, i) && g.difference(i) > 0.0f && no_edge_near(g, c.truth.size, i); });
}

double contact_gap(const Comparison& c)
{
    const Grey g(c);
    constexpr int widest = 32; // more is no gap but a lost shadow
    double lit = 0.0;
    size_t runs = 0;
    const auto walk = [&](size_t first, size_t step, int count) {
        int in_run = 0;
        bool dark_before = false;
        for (int k = 0; k < count; ++k) {
            const size_t i = first + size_t(k) * step;
            const bool dark = g.scored(i) && g.truth(i) <= 0.5f;
            if (dark && !dark_before) in_run = 0, ++runs;
            if (dark && wrong(g, i) && in_run < widest) ++in_run, lit += 1.0;
            dark_before = dark;
        }
    };
    const auto width = size_t(c.truth.size.width);
    for (int y = 0; y < c.truth.size.height; ++y) walk(size_t(y) * width, 1, c.truth.size.width);
    for (int x = 0; x < c.truth.size.width; ++x) walk(size_t(x), width, c.truth.size.height);
    return runs ? lit / double(runs) : 0.0;
}

} // namespace gnomon::metrics
