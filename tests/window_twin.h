// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "scene/math.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

// Brute force over windows of texels, in double: what the tables, pyramids and window maps of shadow/parts are compared with.
namespace gnomon::tests {

using Layers = std::vector<base::Picture>; ///< of one size

inline Layers random_layers(base::Size size, int channels, int layers, uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    Layers out;
    for (int i = 0; i < layers; ++i) {
        out.emplace_back(size, channels);
        for (float& v : out.back().values) v = unit(random);
    }
    return out;
}

/// The windows of shaders/summed_area_table.glsl along one axis: clipped to the image; an empty one is the nearest texel.
struct Span {
    double lo, hi;
    Span(double a, double b, int size)
        : lo(std::clamp(a, 0.0, double(size)))
        , hi(std::clamp(b, 0.0, double(size)))
    {
        if (lo < hi) return;
        lo = std::clamp(std::floor((lo + hi) / 2), 0.0, double(size - 1)), hi = lo + 1;
    }
    int first() const { return int(std::floor(lo)); }
    int last() const { return int(std::ceil(hi)) - 1; }
    double covered(int texel) const { return std::min(hi, texel + 1.0) - std::max(lo, double(texel)); }
};

inline double window_mean(const base::Picture& p, int channel, glm::dvec2 lo, glm::dvec2 hi)
{
    const Span x(lo.x, hi.x, p.size.width), y(lo.y, hi.y, p.size.height);
    double sum = 0, area = 0;
    for (int j = y.first(); j <= y.last(); ++j)
        for (int i = x.first(); i <= x.last(); ++i) {
            const double weight = x.covered(i) * y.covered(j);
            sum += weight * double(p.at(i, j, channel)), area += weight;
        }
    return sum / area;
}

/// Over all texels that the window touches: x = least, y = greatest.
inline vec2 window_min_max(const base::Picture& p, glm::dvec2 lo, glm::dvec2 hi)
{
    const Span x(lo.x, hi.x, p.size.width), y(lo.y, hi.y, p.size.height);
    vec2 out(INFINITY, -INFINITY);
    for (int j = y.first(); j <= y.last(); ++j)
        for (int i = x.first(); i <= x.last(); ++i) out = {std::min(out.x, p.at(i, j)), std::max(out.y, p.at(i, j))};
    return out;
}

} // namespace gnomon::tests
