// SPDX-License-Identifier: Apache-2.0
#include "metrics/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::metrics {

namespace {

constexpr double farthest = 32.0; // pixels; beyond it two edges are not one that moved

/// A pixel is at an edge where it and its right or lower neighbour, both scored, are on different sides of one half.
template <class Value> std::vector<uint8_t> edges(const Grey& g, base::Size size, Value value)
{
    std::vector<uint8_t> found(g.size(), 0);
    const auto lit = [&](size_t i) { return value(i) > 0.5f; };
    for (size_t i = 0; i < g.size(); ++i) {
        if (!g.scored(i)) continue;
        const size_t right = i + 1, below = i + size_t(size.width);
        const bool at_right = right % size_t(size.width) != 0 && g.scored(right) && lit(right) != lit(i);
        const bool at_bottom = below < g.size() && g.scored(below) && lit(below) != lit(i);
        found[i] = at_right || at_bottom;
    }
    return found;
}

/// One row or column of the exact squared distance transform: the lower envelope of parabolas (P. Felzenszwalb, D. Huttenlocher,
/// "Distance Transforms of Sampled Functions", Theory of Computing 8 (2012), section 2). `f` holds squared distances, in and out.
struct Envelope {
    std::vector<double> f, value, border;
    std::vector<int> place;

    void resize(size_t n) { f.resize(n), value.resize(n), border.resize(n + 1), place.resize(n); }
    void transform()
    {
        const int n = int(f.size());
        int k = -1;
        for (int q = 0; q < n; ++q) {
            if (f[size_t(q)] == std::numeric_limits<double>::infinity()) continue;
            double from = -std::numeric_limits<double>::infinity();
            while (k >= 0) {
                const int p = place[size_t(k)];
                from = ((f[size_t(q)] + double(q) * q) - (f[size_t(p)] + double(p) * p)) / (2.0 * (q - p));
                if (from > border[size_t(k)]) break;
                --k;
                from = -std::numeric_limits<double>::infinity();
            }
            ++k;
            place[size_t(k)] = q;
            border[size_t(k)] = from;
        }
        if (k < 0) return; // no source: all stay infinite
        const int last = k;
        k = 0;
        for (int q = 0; q < n; ++q) {
            while (k < last && border[size_t(k) + 1] < q) ++k;
            const int p = place[size_t(k)];
            value[size_t(q)] = double(q - p) * (q - p) + f[size_t(p)];
        }
        f.swap(value);
    }
};

/// Distance in pixels from each pixel to the nearest marked one; infinite where none is marked.
std::vector<double> distances(const std::vector<uint8_t>& marked, base::Size size)
{
    std::vector<double> d(marked.size());
    for (size_t i = 0; i < d.size(); ++i) d[i] = marked[i] ? 0.0 : std::numeric_limits<double>::infinity();
    Envelope line;
    const auto run = [&](size_t first, size_t step, size_t count) {
        line.resize(count);
        for (size_t i = 0; i < count; ++i) line.f[i] = d[first + i * step];
        line.transform();
        for (size_t i = 0; i < count; ++i) d[first + i * step] = line.f[i];
    };
    const auto width = size_t(size.width), height = size_t(size.height);
    for (size_t x = 0; x < width; ++x) run(x, width, height);
    for (size_t y = 0; y < height; ++y) run(y * width, 1, width);
    for (double& v : d) v = std::sqrt(v);
    return d;
}

} // namespace

double edge_displacement(const Comparison& c)
{
    const Grey g(c);
    const std::vector<uint8_t> in_truth = edges(g, c.truth.size, [&](size_t i) { return g.truth(i); });
    const std::vector<uint8_t> in_test = edges(g, c.truth.size, [&](size_t i) { return g.test(i); });
    const std::vector<double> to_truth = distances(in_truth, c.truth.size), to_test = distances(in_test, c.truth.size);
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < g.size(); ++i) {
        if (in_truth[i]) sum += std::min(farthest, to_test[i]), ++count;
        if (in_test[i]) sum += std::min(farthest, to_truth[i]), ++count;
    }
    return count ? sum / double(count) : 0.0;
}

} // namespace gnomon::metrics
