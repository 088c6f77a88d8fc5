// SPDX-License-Identifier: Apache-2.0
#include "metrics/flip_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::metrics {

namespace {

struct Separable {
    std::vector<double> row, column;
};

void apply(const std::vector<float>& in, base::Size size, const Separable& filter, double weight, std::vector<float>& sum)
{
    const int radius = int(filter.row.size() / 2), width = size.width, height = size.height;
    std::vector<float> between(in.size()), line(size_t(width + 2 * radius));
    for (int y = 0; y < height; ++y) {
        const float* source = in.data() + size_t(y) * size_t(width);
        for (int x = 0; x < int(line.size()); ++x) line[size_t(x)] = source[std::clamp(x - radius, 0, width - 1)];
        float* target = between.data() + size_t(y) * size_t(width);
        for (int k = 0; k <= 2 * radius; ++k) {
            const auto w = float(filter.row[size_t(k)]);
            for (int x = 0; x < width; ++x) target[x] += w * line[size_t(x + k)];
        }
    }
    for (int y = 0; y < height; ++y) {
        float* target = sum.data() + size_t(y) * size_t(width);
        for (int k = 0; k <= 2 * radius; ++k) {
            const auto w = float(filter.column[size_t(k)] * weight);
            const float* source = between.data() + size_t(std::clamp(y + k - radius, 0, height - 1)) * size_t(width);
            for (int x = 0; x < width; ++x) target[x] += w * source[x];
        }
    }
}

struct Gaussian {
    double a, b;
};

/// Contrast sensitivity of each opponent channel as sums of Gaussians (eq. 3 and table 1).
constexpr std::array<std::array<Gaussian, 2>, 3> sensitivity{{
    {{{1.0, 0.0047}, {0.0, 1e-5}}},
    {{{1.0, 0.0053}, {0.0, 1e-5}}},
    {{{34.1, 0.04}, {13.5, 0.025}}},
}};

} // namespace

Planes seen(const Planes& opponent, double pixels_per_degree)
{
    constexpr double pi = std::numbers::pi, widest = 0.04;
    const int radius = int(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
    Planes result(opponent.size);
    for (size_t c = 0; c < 3; ++c) {
        // The discrete sum of each two-dimensional Gaussian is the square of its one-dimensional sum.
        std::array<Separable, 2> filter;
        std::array<double, 2> weight{};
        double total = 0.0;
        for (size_t k = 0; k < 2; ++k) {
            const auto [a, b] = sensitivity[c][k];
            double sum = 0.0;
            for (int x = -radius; x <= radius; ++x) {
                const double degrees = x / pixels_per_degree;
                filter[k].row.push_back(std::exp(-pi * pi * degrees * degrees / b));
                sum += filter[k].row.back();
            }
            filter[k].column = filter[k].row;
            weight[k] = a * std::sqrt(pi / b);
            total += weight[k] * sum * sum;
        }
        for (size_t k = 0; k < 2; ++k)
            if (weight[k] > 0.0) apply(opponent.channel[c], opponent.size, filter[k], weight[k] / total, result.channel[c]);
    }
    for (size_t i = 0; i < result.size.area(); ++i) {
        Color rgb = rgb_from_ycxcz(result.at(i));
        for (float& v : rgb) v = std::clamp(v, 0.0f, 1.0f);
        result.set(i, rgb);
    }
    return result;
}

namespace {

/// Positive weights made to sum to 1, negative ones to -1.
std::vector<double> balanced(std::vector<double> taps)
{
    double positive = 0.0, negative = 0.0;
    for (const double t : taps) (t > 0 ? positive : negative) += t;
    for (double& t : taps) t /= t > 0 ? positive : -negative;
    return taps;
}

} // namespace

Features features(const std::vector<float>& plane, base::Size size, double pixels_per_degree)
{
    // Derivatives of a Gaussian of half the width of a feature as people see it, 0.082 degrees (section 4.2).
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = std::max(1, int(std::ceil(3 * deviation)));
    std::vector<double> smooth, first, second;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        const double g = std::exp(-x * x / (2 * deviation * deviation));
        smooth.push_back(g);
        sum += g;
        first.push_back(-x * g);
        second.push_back((x * x / (deviation * deviation) - 1) * g);
    }
    for (double& g : smooth) g /= sum;
    first = balanced(std::move(first));
    second = balanced(std::move(second));
    const auto length = [&](const std::vector<double>& taps) {
        std::vector<float> along_x(plane.size()), along_y(plane.size());
        apply(plane, size, {taps, smooth}, 1.0, along_x);
        apply(plane, size, {smooth, taps}, 1.0, along_y);
        for (size_t i = 0; i < plane.size(); ++i) along_x[i] = std::hypot(along_x[i], along_y[i]);
        return along_x;
    };
    return {length(first), length(second)};
}

} // namespace gnomon::metrics
