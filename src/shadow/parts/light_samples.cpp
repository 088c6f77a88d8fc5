// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/light_samples.h"

#include "scene/light.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace gnomon::shadow::parts {

namespace {

std::vector<int> shuffled(int count, std::mt19937& random)
{
    std::vector<int> out(size_t(count), 0);
    std::iota(out.begin(), out.end(), 0);
    for (int i = count - 1; i > 0; --i) std::swap(out[size_t(i)], out[random() % uint32_t(i + 1)]);
    return out;
}

/// Coordinates in [0, count)^2, each number once an axis, and one point in each of side x side strata. A shuffle of its own for each
/// row and column of strata: with one for all, samples line up along diagonals.
std::vector<glm::ivec2> multi_jittered(int side)
{
    std::mt19937 random(7);
    std::vector<std::vector<int>> across, down;
    for (int i = 0; i < side; ++i) across.push_back(shuffled(side, random)), down.push_back(shuffled(side, random));
    std::vector<glm::ivec2> out;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) out.emplace_back(x * side + across[size_t(x)][size_t(y)], y * side + down[size_t(y)][size_t(x)]);
    return out;
}

} // namespace

LightSamples light_samples(int count, bool disk)
{
    const auto cell = [](float unit) { return std::clamp(int(unit * light_sample_grid), 0, light_sample_grid - 1); };
    LightSamples out;
    for (const glm::ivec2 at : multi_jittered(int(std::lround(std::sqrt(float(count)))))) {
        vec2 unit = (vec2(at) + 0.5f) / float(count);
        if (disk) unit = 0.5f + 0.5f * scene::square_to_disk(unit);
        out.cells.emplace_back(cell(unit.x), cell(unit.y));
    }
    std::stable_sort(out.cells.begin(), out.cells.end(), [](glm::ivec2 a, glm::ivec2 b) { return a.x < b.x; });
    for (int border = 0; border <= light_sample_grid; ++border)
        out.table.push_back(uint32_t(std::ranges::count_if(out.cells, [&](glm::ivec2 c) { return c.x < border; })));
    for (int border = 0; border <= light_sample_grid; ++border)
        for (int word = 0; word < count / 32; ++word) {
            uint32_t bits = 0;
            for (int i = 0; i < 32; ++i) bits |= uint32_t(out.cells[size_t(32 * word + i)].y < border) << i;
            out.table.push_back(bits);
        }
    return out;
}

} // namespace gnomon::shadow::parts
