// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sampling_error.h"
#include "shadow/parts/warp_parameter.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

/// Place along the map of what the view sees at depth z, under the vertical angle of tangent `slope`.
double along(double gamma, double z, double slope) { return z * (std::sin(gamma) + slope * std::cos(gamma)); }

WarpLine line_of(const Frustum& f, double gamma)
{
    // (4.17): from the near plane as far in depth as the map's extent takes a line across the light
    const double extent = tilted_span(f, gamma).extent(), end = f.near + extent * std::sin(gamma);
    return {f.near, end, extent, f.near, end};
}

} // namespace

Span tilted_span(const Frustum& f, double gamma)
{
    const double slope = std::tan(f.half_fov);
    const double a = along(gamma, f.near, slope), b = along(gamma, f.near, -slope);
    const double c = along(gamma, f.far, slope), d = along(gamma, f.far, -slope);
    return {std::min({a, b, c, d}), std::max({a, b, c, d})};
}

Error tilted_largest(const Frustum& f, double gamma, double n, int steps)
{
    const Span span = tilted_span(f, gamma);
    const double extent = span.extent(), slope = std::tan(f.half_fov), half_width = f.aspect * slope;
    const bool uniform = std::isinf(n);
    // v' over n; the map's width takes the corner that is widest after the warp
    const auto stretch = [&](double z, double at) { return uniform ? 1.0 : 1.0 + (along(gamma, z, at) - span.least) / n; };
    double widest = 0.0;
    for (const double z : {f.near, f.far})
        for (const double at : {-slope, slope}) widest = std::max(widest, half_width * z / stretch(z, at));
    Error largest{0.0, 0.0};
    for (int i = 0; i <= steps; ++i) {
        const double z = f.near * std::pow(f.ratio(), double(i) / steps);
        for (int k = 0; k <= steps; ++k) {
            const double at = slope * (2.0 * k / steps - 1.0), v = stretch(z, at);
            // (3.9): dv/dt = extent v'^2 / (f n), and the pixel's beam is narrower by its cosine; (3.10): du/ds = 2 widest v' / n
            const double dv = extent * v * v / (uniform ? 1.0 : 1.0 + extent / n);
            largest.t = std::max(largest.t, dv * std::sqrt(1.0 + at * at) / (2.0 * slope * z));
            largest.s = std::max(largest.s, 2.0 * widest * v / (2.0 * half_width * z));
        }
    }
    return largest;
}

double tilted_best_near(const Frustum& f, double gamma)
{
    const auto cost = [&](double n) { return storage(tilted_largest(f, gamma, n)); };
    const double extent = tilted_span(f, gamma).extent(), factor = std::pow(1e6, 1.0 / 240.0);
    double best = no_warp, least = cost(no_warp);
    for (double n = 1e-3 * extent; n < 1e3 * extent; n *= factor)
        if (const double now = cost(n); now < least * (1.0 - 1e-9)) best = n, least = now;
    if (std::isinf(best)) return best;
    // golden section between the neighbours on the grid
    double low = best / factor, high = best * factor;
    for (int i = 0; i < 40; ++i) {
        const double a = high - 0.6180339887498949 * (high - low), b = low + 0.6180339887498949 * (high - low);
        (cost(a) <= cost(b) ? high : low) = cost(a) <= cost(b) ? b : a;
    }
    return 0.5 * (low + high);
}

double tilted_optimal_near(const Frustum& f, double gamma)
{
    const WarpLine line = line_of(f, gamma);
    return optimal_near(line.z0, line.z1, line.extent);
}

double tilted_shaped_near(const Frustum& f, double gamma) { return warp_near(line_of(f, gamma), gamma, f.half_fov); }

} // namespace gnomon::shadow::parts
