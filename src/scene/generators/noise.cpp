// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/noise.h"

#include <cmath>

namespace gnomon::scene::generators {

namespace {

uint32_t wrapped(int i, int period)
{
    return uint32_t(((i % period) + period) % period);
}

} // namespace

float value_noise(vec2 p, int period, uint32_t seed)
{
    const vec2 cell = glm::floor(p);
    const vec2 f = p - cell;
    const vec2 s = f * f * (3.0f - 2.0f * f);
    const int x = int(cell.x), y = int(cell.y);
    const auto corner = [&](int dx, int dy) { return hash01(wrapped(x + dx, period), wrapped(y + dy, period), seed); };
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
