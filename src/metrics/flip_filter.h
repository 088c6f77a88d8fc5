// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/picture.h"
#include "metrics/flip_color.h"

// The filters of FLIP (flip.cpp). All are products of a row and a column filter; borders repeat the last pixel.
namespace gnomon::metrics {

/// Three planes of one size.
struct Planes {
    base::Size size;
    std::array<std::vector<float>, 3> channel;
    explicit Planes(base::Size s)
        : size(s)
    {
        for (auto& c : channel) c.resize(s.area());
    }
    Color at(size_t i) const { return {channel[0][i], channel[1][i], channel[2][i]}; }
    void set(size_t i, const Color& c)
    {
        for (size_t k = 0; k < 3; ++k) channel[k][i] = c[k];
    }
};

/// From YCxCz to what the eye keeps of it at this resolution, in linear RGB clamped to what the display shows.
Planes seen(const Planes& opponent, double pixels_per_degree);

/// The strength of edges and of points at each pixel of a plane of values in [0, 1].
struct Features {
    std::vector<float> edge, point;
};
Features features(const std::vector<float>& plane, base::Size, double pixels_per_degree);

} // namespace gnomon::metrics
