// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "metrics/flip_filter.h"
#include "metrics/metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
// Section numbers in these files (flip, flip_color, flip_filter) are of that paper.
namespace gnomon::metrics {

namespace {

constexpr double color_power = 0.7, feature_power = 0.5; // section 4.1.3 and 4.2

Planes opponent(const base::Picture& p)
{
    if ((p.channels != 1 && p.channels != 3) || p.values.size() != p.size.area() * size_t(p.channels))
        base::fail("FLIP needs pictures of 1 or 3 channels, not {}", p.channels);
    Planes result(p.size);
    for (size_t i = 0; i < p.size.area(); ++i) {
        Color rgb;
        for (size_t k = 0; k < 3; ++k) {
            const float v = p.values[p.channels == 1 ? i : i * 3 + k];
            rgb[k] = v > 0.0f ? std::min(v, 1.0f) : 0.0f; // also NaN
        }
        result.set(i, ycxcz(rgb));
    }
    return result;
}

/// Small colour differences take most of [0, 1]: up to 0.4 of the largest one they map linearly to [0, 0.95] (section 4.1.3).
double redistributed(double difference, double largest)
{
    constexpr double knee = 0.4, at_knee = 0.95;
    const double d = std::pow(difference, color_power), limit = knee * largest;
    return d < limit ? at_knee / limit * d : at_knee + (d - limit) / (largest - limit) * (1.0 - at_knee);
}

std::vector<float> luminance(const Planes& p)
{
    std::vector<float> y = p.channel[0];
    for (float& v : y) v = (v + 16.0f) / 116.0f;
    return y;
}

} // namespace

double flip(const base::Picture& test, const base::Picture& truth, base::Picture* error_map, float pixels_per_degree)
{
    if (test.size != truth.size || test.empty())
        base::fail("FLIP cannot compare {}x{} pixels with {}x{}; render both at one size", test.size.width, test.size.height,
            truth.size.width, truth.size.height);
    if (!(pixels_per_degree >= 1.0f && pixels_per_degree <= 1000.0f))
        base::fail("{} pixels per degree are not between 1 and 1000; 67 is a screen at arm's length", pixels_per_degree);
    const double ppd = double(pixels_per_degree);
    const Planes a = opponent(test), b = opponent(truth), seen_a = seen(a, ppd), seen_b = seen(b, ppd);
    const Features fa = features(luminance(a), a.size, ppd), fb = features(luminance(b), b.size, ppd);
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), color_power);

    double sum = 0.0;
    if (error_map) *error_map = base::Picture(truth.size, 1);
    for (size_t i = 0; i < truth.size.area(); ++i) {
        const double color = redistributed(hyab(hunt_lab(seen_a.at(i)), hunt_lab(seen_b.at(i))), largest);
        const double edge = std::abs(double(fa.edge[i]) - double(fb.edge[i])), point = std::abs(double(fa.point[i]) - double(fb.point[i]));
        const double feature = std::pow(std::min(1.0, std::numbers::sqrt2 / 2 * std::max(edge, point)), feature_power);
        const double error = std::clamp(std::pow(color, 1.0 - feature), 0.0, 1.0);
        sum += error;
        if (error_map) error_map->values[i] = float(error);
    }
    return sum / double(truth.size.area());
}

} // namespace gnomon::metrics
