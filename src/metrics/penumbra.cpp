// SPDX-License-Identifier: Apache-2.0
#include "metrics/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::metrics {

namespace {

/// A row or a column of a picture.
struct Line {
    size_t first, step;
    int count;
    size_t pixel(int i) const { return first + size_t(i) * step; }
};

template <class Visit> void each_line(base::Size size, Visit visit)
{
    for (int y = 0; y < size.height; ++y) visit(Line{size_t(y) * size_t(size.width), 1, size.width});
    for (int x = 0; x < size.width; ++x) visit(Line{size_t(x), size_t(size.width), size.height});
}

/// Where a line's values, going from `i` by `way`, first reach `level` from the side of one half: in pixels from `i`. Nothing where the
/// line ends, leaves the scored pixels or turns back across one half before.
template <class Value> std::optional<double> reaches(const Grey& g, const Line& line, int i, int way, float level, Value value)
{
    const bool up = level > 0.5f;
    float before = value(line.pixel(i));
    if (up ? before >= level : before <= level) return 0.0;
    for (int j = i + way; j >= 0 && j < line.count && g.scored(line.pixel(j)); j += way) {
        const float here = value(line.pixel(j));
        if (up ? here >= level : here <= level) return std::abs(j - way - i) + double((level - before) / (here - before));
        if (up ? here < 0.5f : here > 0.5f) return {};
        before = here;
    }
    return {};
}

/// Distance from 10 % to 90 % visibility about a crossing of one half between pixels i and i + 1; nothing where a value turns back.
template <class Value> std::optional<double> profile(const Grey& g, const Line& line, int i, Value value)
{
    const bool rising = value(line.pixel(i + 1)) > value(line.pixel(i));
    const auto left = reaches(g, line, i, -1, rising ? 0.1f : 0.9f, value), right = reaches(g, line, i + 1, 1, rising ? 0.9f : 0.1f, value);
    if (!left || !right) return {};
    // where one pixel holds all of it, no more can be known than that it is narrower
    return std::max(1.0, *left + *right + 1.0);
}

template <class Value> bool crosses(const Grey& g, const Line& line, int i, Value value)
{
    if (i < 0 || i + 1 >= line.count || !g.scored(line.pixel(i)) || !g.scored(line.pixel(i + 1))) return false;
    return (value(line.pixel(i)) > 0.5f) != (value(line.pixel(i + 1)) > 0.5f);
}

/// The test's profile nearest to the truth's at `i`, in the same direction, as far away as the penumbra is wide.
std::optional<double> matching_profile(const Grey& g, const Line& line, int i, double width)
{
    const auto truth = [&](size_t pixel) { return g.truth(pixel); };
    const auto test = [&](size_t pixel) { return g.test(pixel); };
    const bool rising = truth(line.pixel(i + 1)) > 0.5f;
    const int farthest = std::max(2, int(width));
    for (int away = 0; away <= farthest; ++away)
        for (const int j : {i - away, i + away})
            if (crosses(g, line, j, test) && (test(line.pixel(j + 1)) > 0.5f) == rising)
                if (const auto found = profile(g, line, j, test)) return found;
    return {};
}

bool in_penumbra(const Grey& g, size_t i) { return g.scored(i) && g.truth(i) > fully_dark && g.truth(i) < fully_lit; }

/// Median of the error over the scored pixels of the true penumbra in 5 x 5: it drops what single pixels do, and keeps steps.
std::vector<float> median_errors(const Grey& g, base::Size size)
{
    std::vector<float> out(g.size(), 0.0f);
    std::array<float, 25> window{};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const size_t i = size_t(y) * size_t(size.width) + size_t(x);
            if (!in_penumbra(g, i)) continue;
            size_t count = 0;
            for (int v = std::max(0, y - 2); v <= std::min(size.height - 1, y + 2); ++v)
                for (int u = std::max(0, x - 2); u <= std::min(size.width - 1, x + 2); ++u) {
                    const size_t j = size_t(v) * size_t(size.width) + size_t(u);
                    if (in_penumbra(g, j)) window[count++] = g.difference(j);
                }
            const auto middle = window.begin() + std::ptrdiff_t(count / 2);
            std::nth_element(window.begin(), middle, window.begin() + std::ptrdiff_t(count));
            out[i] = *middle;
        }
    return out;
}

} // namespace

double penumbra_width(const Comparison& c)
{
    const Grey g(c);
    double wrong = 0.0, whole = 0.0;
    const auto truth = [&](size_t pixel) { return g.truth(pixel); };
    each_line(c.truth.size, [&](const Line& line) {
        for (int i = 0; i + 1 < line.count; ++i) {
            if (!crosses(g, line, i, truth)) continue;
            const auto width = profile(g, line, i, truth);
            if (!width) continue;
            whole += *width;
            const auto found = matching_profile(g, line, i, *width);
            wrong += found ? std::abs(*found - *width) : *width;
        }
    });
    return whole > 0.0 ? wrong / whole : 0.0;
}

double banding(const Comparison& c)
{
    const Grey g(c);
    const std::vector<float> errors = median_errors(g, c.truth.size);
    double sum = 0.0;
    size_t bends = 0;
    each_line(c.truth.size, [&](const Line& line) {
        for (int i = 1; i + 1 < line.count; ++i) {
            const size_t before = line.pixel(i - 1), here = line.pixel(i), after = line.pixel(i + 1);
            if (!in_penumbra(g, before) || !in_penumbra(g, here) || !in_penumbra(g, after)) continue;
            sum += std::abs(errors[before] - 2.0f * errors[here] + errors[after]);
            ++bends;
        }
    });
    return bends ? sum / double(bends) : 0.0;
}

double grain(const Comparison& c)
{
    const Grey g(c);
    const std::vector<float> errors = median_errors(g, c.truth.size);
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < g.size(); ++i) {
        if (!in_penumbra(g, i)) continue;
        sum += std::abs(g.difference(i) - errors[i]);
        ++count;
    }
    return count ? sum / double(count) : 0.0;
}

} // namespace gnomon::metrics
