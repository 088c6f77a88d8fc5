// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device_fixture.h"
#include "filter_identities.shared.h"
#include "glsl_function.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {

using shaders::WindowCase;
using shaders::WindowResult;

constexpr double unit_roundoff = 0x1p-24; // of one float operation, relative

/// (centred depth, weight). Weights are multiples of 1/64: they add up to 1 without rounding.
using Depths = std::vector<vec2>;

inline Depths two_depths(float a, float b, float fraction_at_a) { return {{a, fraction_at_a}, {b, 1.0f - fraction_at_a}}; }

inline double lit_fraction(const Depths& depths, float t)
{
    double sum = 0;
    for (const vec2 z : depths) sum += z.x >= t ? double(z.y) : 0.0;
    return sum;
}

/// 2 to 16 depths that spread over at least a twentieth of the range, so that float moments know them apart.
inline Depths random_depths(std::mt19937& random)
{
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (;;) {
        const int n = 2 + int(random() % 15);
        const float extent = unit(random) < 0.5f ? 1.0f : 0.05f + 0.2f * unit(random),
                    centre = (1.0f - extent) * (2.0f * unit(random) - 1.0f);
        Depths out;
        for (int i = 0; i < n; ++i) out.emplace_back(centre + extent * (2.0f * unit(random) - 1.0f), 1.0f / 64.0f);
        for (int rest = 64 - n; rest > 0; --rest) out[random() % size_t(n)].y += 1.0f / 64.0f;
        const auto [least, greatest] = std::ranges::minmax_element(out, {}, &vec2::x);
        if (greatest->x - least->x > 0.1f) return out;
    }
}

/// A receiver anywhere, or on one of the depths, where bounds are tight.
inline float random_receiver(const Depths& depths, std::mt19937& random)
{
    std::uniform_real_distribution<float> centred(-1.0f, 1.0f);
    return random() % 2 ? centred(random) : depths[random() % depths.size()].x;
}

class FilterIdentities : public gpu::DeviceTest {
protected:
    void add(const Depths& depths, float t, WindowCase c = {})
    {
        c.first = int(all_depths_.size()), c.count = int(depths.size()), c.t = t;
        cases_.push_back(c), windows_.push_back(depths), lit_.push_back(lit_fraction(depths, t));
        all_depths_.insert(all_depths_.end(), depths.begin(), depths.end());
    }
    void run()
    {
        gpu::Buffer depths = storage<vec2>("depths", std::span<const vec2>(all_depths_));
        results_ = gpu::run_glsl_cases<WindowResult>(device(), "tests/gpu/filter_identities.comp", cases_, &depths);
    }

    /// How far `what` falls below the exact fraction, at worst.
    double worst_below(float WindowResult::*what) const
    {
        double worst = -1;
        for (size_t i = 0; i < results_.size(); ++i) worst = std::max(worst, lit_[i] - double(results_[i].*what));
        return worst;
    }
    double mean_error(float WindowResult::*what, size_t first, size_t last) const
    {
        double sum = 0;
        for (size_t i = first; i < last; ++i) sum += std::abs(double(results_[i].*what) - lit_[i]);
        return sum / double(last - first);
    }

    std::vector<vec2> all_depths_;
    std::vector<WindowCase> cases_;
    std::vector<Depths> windows_;
    std::vector<double> lit_; // exact
    std::vector<WindowResult> results_;
};

} // namespace gnomon
