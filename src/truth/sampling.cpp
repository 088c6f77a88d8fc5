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

Strata::Strata(int samples, uint64_t s)
    : side(std::max(1, int(std::ceil(std::sqrt(double(samples))))))
    , seed(mixed(s))
{
}

vec2 Strata::point(uint64_t pixel, int column, int row) const
{
    const uint64_t bits = mixed(mixed(seed ^ pixel) + uint64_t(row) * uint64_t(side) + uint64_t(column));
    const vec2 jitter(float(bits >> 40) * 0x1p-24f, float((bits >> 16) & 0xffffffu) * 0x1p-24f);
    const vec2 u = (vec2(column, row) + jitter) / float(side);
    return glm::min(u, vec2(1.0f - 0x1p-24f)); // the sum may round up to 1
}

Estimate estimate(std::span<const float> values, int side)
{
    const auto snake = [&](size_t i) {
        const size_t row = i / size_t(side), column = i % size_t(side);
        return double(values[row * size_t(side) + (row % 2 ? size_t(side) - 1 - column : column)]);
    };
    const size_t count = values.size();
    double sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; ++i) sum += snake(i);
    const auto add_pair = [&](size_t i) { squares += (snake(i) - snake(i + 1)) * (snake(i) - snake(i + 1)); };
    for (size_t i = 0; i + 1 < count; i += 2) add_pair(i);
    if (count % 2 == 1 && count > 1) add_pair(count - 2); // the odd one out: its pair counts twice in part, on the safe side
    return {sum / double(count), squares / (double(count) * double(count))};
}

} // namespace gnomon::truth
