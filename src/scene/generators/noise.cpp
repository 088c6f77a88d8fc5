// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/noise.h"

#include <cmath>

namespace gnomon::scene::generators {

namespace {

uint32_t wrapped(int i, int period) { return uint32_t(((i % period) + period) % period); }

} // namespace

float value_noise(vec2 p, int period, uint32_t seed)
{
    const vec2 cell = glm::floor(p);
    const vec2 f = p - cell;
    const vec2 s = f * f * (3.0f - 2.0f * f);
    const uint32_t x[2] = {wrapped(int(cell.x), period), wrapped(int(cell.x) + 1, period)};
    const uint32_t y[2] = {wrapped(int(cell.y), period), wrapped(int(cell.y) + 1, period)};
    // One scramble of a linear mix: a third of the time of hash01, which textures feel.
    const auto corner = [&](int i, int j) { return unit_float(scramble(x[i] * 0x8da6b343u + y[j] * 0xd8163841u + seed * 0xcb1ab31fu)); };
    return glm::mix(glm::mix(corner(0, 0), corner(1, 0), s.x), glm::mix(corner(0, 1), corner(1, 1), s.x), s.y);
}

float fractal_noise(vec2 p, int period, int octaves, uint32_t seed)
{
    float sum = 0.0f, weight = 0.0f, amplitude = 1.0f;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * value_noise(p, period, seed + uint32_t(i));
        weight += amplitude;
        amplitude *= 0.5f;
        p *= 2.0f;
        period *= 2;
    }
    return sum / weight;
}

} // namespace gnomon::scene::generators
