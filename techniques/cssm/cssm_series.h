// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "techniques/cssm/cssm.shared.h"

#include <cmath>
#include <numbers>

namespace gnomon::techniques::cssm {

/// Rise of the series of M terms over its middle, at x half periods from the step: 2 sum sin(c_k x) / c_k, c_k = pi (2k - 1).
inline double series_rise(int terms, double x)
{
    double sum = 0;
    for (int k = 1; k <= terms; ++k) sum += 2 * std::sin(std::numbers::pi * (2 * k - 1) * x) / (std::numbers::pi * (2 * k - 1));
    return sum;
}

/// Scale and shift after which ripples lie above 1 and below 0 only, so that cutting there removes them.
///
/// The rise's slope is 2 sum cos(c_k x) = sin(2 M pi x) / sin(pi x): extrema at x = i / (2M), the first a peak, the second, 1 / M, the
/// lowest trough. Scaled to 1/2 there (by 1.18, 1.12, 1.11 for 2, 4, 16 terms), the series reaches 1/2 first at some x0 < 1 / (2M) (0.119,
/// 0.064, 0.016) and holds it to 1 - x0. Compared with a receiver that is x0 nearer, a surface on its own depth is lit, blockers are dark
/// from 2 x0 on, and depths may fill 1 - 2 x0 of the half period before what lies far behind the receiver turns dark again.
///
/// `quantum`: steps of the stored sines and cosines, which lie in [0, 1]. Their rounding, the same all over a level surface, must not take
/// from its light: the shift makes up for it.
inline Series make_series(int terms, double quantum)
{
    const int groups = (terms + 1) / 2;
    terms = 2 * groups;
    const double scale = 0.5 / series_rise(terms, 1.0 / terms);
    double lo = 0, hi = 0.5 / terms;
    for (int i = 0; i < 50; ++i) (scale * series_rise(terms, 0.5 * (lo + hi)) < 0.5 ? lo : hi) = 0.5 * (lo + hi);
    double rounding = 1e-5;
    for (int k = 1; k <= terms; ++k) rounding += scale * std::numbers::sqrt2 * quantum * 2 / (std::numbers::pi * (2 * k - 1));
    const double slope = scale * std::sin(2 * terms * std::numbers::pi * hi) / std::sin(std::numbers::pi * hi);
    const double shift = hi + rounding / slope;
    return {groups, float(scale), float(shift), float(1 - 2 * shift)};
}

} // namespace gnomon::techniques::cssm
