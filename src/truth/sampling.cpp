// SPDX-License-Identifier: Apache-2.0
#include "truth/sampling.h"

#include <algorithm>
#include <cmath>

namespace gnomon::truth {

namespace {

uint64_t mixed(uint64_t v) // splitmix64
{
    v += 0x9e3779b97f4a7c15ull;
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
    return v ^ (v >> 31);
}

} // namespace

Strata::Strata(int samples, uint64_t s, glm::ivec2 texels)
    : columns(std::max(1, int(std::ceil(std::sqrt(double(samples))))))
    , rows(columns)
    , seed(mixed(s))
{
    columns = (columns + texels.x - 1) / texels.x * texels.x;
    rows = (rows + texels.y - 1) / texels.y * texels.y;
}

vec2 Strata::point(uint64_t pixel, int column, int row) const
{
    const uint64_t bits = mixed(mixed(seed ^ pixel) + uint64_t(row) * uint64_t(columns) + uint64_t(column));
    const vec2 jitter(float(bits >> 40) * 0x1p-24f, float((bits >> 16) & 0xffffffu) * 0x1p-24f);
    const vec2 u = (vec2(column, row) + jitter) / vec2(columns, rows);
    return glm::min(u, vec2(1.0f - 0x1p-24f)); // the sum may round up to 1
}

Estimate estimate(std::span<const float> values, int columns, std::span<const float> weights)
{
    const auto snake = [&](size_t i) {
        const size_t row = i / size_t(columns), column = i % size_t(columns);
        return row * size_t(columns) + (row % 2 ? size_t(columns) - 1 - column : column);
    };
    const auto weight = [&](size_t stratum) { return weights.empty() ? 1.0 : double(weights[stratum]); };
    const size_t count = values.size();
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; ++i) sum += weight(snake(i)) * double(values[snake(i)]);
    const auto add_pair = [&](size_t i) {
        const size_t a = snake(i), b = snake(i + 1);
        const double difference = double(values[a]) - double(values[b]);
        squares += 0.5 * (weight(a) * weight(a) + weight(b) * weight(b)) * difference * difference;
    };
    for (size_t i = 0; i + 1 < count; i += 2) add_pair(i);
    if (count % 2 == 1 && count > 1) add_pair(count - 2); // the odd one out: its pair counts twice in part, on the safe side
    return {sum / double(count), squares / (double(count) * double(count))};
}

} // namespace gnomon::truth
