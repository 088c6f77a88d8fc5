// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <cstdint>

// Hashing instead of <random>: its distributions differ between standard libraries, and a scene must be the same everywhere.
namespace gnomon::scene::generators {

/// Scrambles 32 bits (Wellons' lowbias32).
constexpr uint32_t scramble(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
constexpr uint32_t scramble(uint32_t a, uint32_t b) { return scramble(a ^ scramble(b + 0x9e3779b9u)); }

constexpr float unit_float(uint32_t bits) { return float(bits >> 8) * (1.0f / 16777216.0f); }

/// In [0, 1), by place.
constexpr float hash01(uint32_t a, uint32_t b = 0, uint32_t c = 0) { return unit_float(scramble(a, scramble(b, c))); }

/// A stream of numbers in [0, 1).
class Random {
public:
    explicit Random(uint32_t seed)
        : seed_(seed)
    {
    }
    float next() { return unit_float(scramble(seed_, ++count_)); }
    float between(float low, float high) { return low + (high - low) * next(); }
    int below(int n) { return int(next() * float(n)); }

private:
    uint32_t seed_, count_ = 0;
};

/// Smooth value noise in [0, 1]; repeats every `period` cells (for textures that tile).
float value_noise(vec2 p, int period, uint32_t seed);
/// Octaves of it, each half as strong, in [0, 1].
float fractal_noise(vec2 p, int period, int octaves, uint32_t seed);

} // namespace gnomon::scene::generators
