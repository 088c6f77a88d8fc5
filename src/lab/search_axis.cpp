// SPDX-License-Identifier: Apache-2.0
#include "lab/search.h"

#include <algorithm>
#include <cmath>

namespace gnomon::lab {

namespace {

constexpr double decades = 5.0;
constexpr double zero_part = 0.1; ///< of [0, 1] that stands for 0 itself, where an axis has it and is logarithmic beyond

/// Three significant digits: what a preset shows is what was measured, and neighbours differ visibly.
double rounded(double value)
{
    if (value == 0.0 || !std::isfinite(value)) return value;
    const double digit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
    // by division where the digit is below 1: multiples of 0.001 are no doubles, and 1000 is
    return digit < 1.0 ? std::round(value / digit) / std::round(1.0 / digit) : std::round(value / digit) * digit;
}

} // namespace

double Axis::value(double unit) const
{
    const double u = std::clamp(unit, 0.0, 1.0);
    if (!ordered_) return std::min(std::floor(u * (high_ + 1.0)), high_);
    double v = low_ + u * (high_ - low_);
    if (scale_ == Scale::logarithmic)
        v = low_ * std::pow(high_ / low_, u);
    else if (scale_ == Scale::zero_and_logarithmic)
        v = u < zero_part ? 0.0 : high_ * std::pow(10.0, decades * ((u - zero_part) / (1.0 - zero_part) - 1.0));
    return std::clamp(whole_ ? std::round(v) : rounded(v), low_, high_);
}

double Axis::unit(double value) const
{
    if (!ordered_) return (value + 0.5) / (high_ + 1.0);
    if (high_ == low_) return 0.0;
    if (scale_ == Scale::logarithmic) return std::log(value / low_) / std::log(high_ / low_);
    if (scale_ == Scale::zero_and_logarithmic) {
        if (value <= 0.0) return 0.5 * zero_part;
        return zero_part + (1.0 - zero_part) * std::max(0.0, 1.0 + std::log10(value / high_) / decades);
    }
    return (value - low_) / (high_ - low_);
}

double Axis::moved(double from, double by) const
{
    // Whole numbers, and 0 before a logarithmic part, are wider than a small step.
    for (double step = by; std::abs(step) <= 1.0; step *= 2.0)
        if (const double to = value(unit(from) + step); to != from) return to;
    return value(by > 0 ? 1.0 : 0.0);
}

} // namespace gnomon::lab
