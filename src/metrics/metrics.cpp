// SPDX-License-Identifier: Apache-2.0
#include "metrics/metrics.h"

#include "base/error.h"
#include "metrics/comparison.h"

#include <algorithm>
#include <cmath>

namespace gnomon::metrics {

Grey::Grey(const Comparison& c)
    : test_(c.test)
    , truth_(c.truth)
    , variance_(c.variance)
    , mask_(c.mask)
{
    const auto whole = [](const base::Picture& p) {
        return (p.channels == 1 || p.channels == 3) && p.values.size() == p.size.area() * size_t(p.channels);
    };
    if (!whole(test_) || !whole(truth_) || test_.size != truth_.size || test_.channels != truth_.channels)
        base::fail("cannot compare a picture of {}x{} pixels and {} channels with one of {}x{} and {}; render both at one size, with 1 or "
                   "3 channels",
            test_.size.width, test_.size.height, test_.channels, truth_.size.width, truth_.size.height, truth_.channels);
    if (mask_.size() != truth_.size.area()) base::fail("the mask has {} entries for {} pixels", mask_.size(), truth_.size.area());
    if (!variance_.empty() && (variance_.size != truth_.size || variance_.channels != truth_.channels))
        base::fail("the variance has {}x{} pixels and {} channels, unlike the truth", variance_.size.width, variance_.size.height,
            variance_.channels);
}

float Grey::test(size_t pixel) const
{
    const float value = mean(test_, pixel);
    return std::isfinite(value) ? value : truth(pixel) > 0.5f ? 0.0f : 1.0f;
}

Grey::Sizes Grey::error(size_t pixel) const
{
    const auto channels = size_t(test_.channels);
    Sizes out;
    for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i) {
        const float t = truth_.values[i], value = std::isfinite(test_.values[i]) ? test_.values[i] : t > 0.5f ? 0.0f : 1.0f;
        const double e = std::abs(double(value - t));
        out.mean += e / double(channels), out.square += e * e / double(channels), out.largest = std::max(out.largest, e);
    }
    return out;
}

const std::vector<Metric>& metrics()
{
    static const std::vector<Metric> all{
        {"wrong_pixels", "fraction", "pixels on the wrong side of the shadow's edge", true, false, wrong_pixels},
        {"acne", "fraction", "lit pixels that are shown dark", true, true, acne},
        {"leak", "fraction", "dark pixels that are shown lit", true, true, leak},
        {"wrong_outside_band", "fraction", "wrong pixels with no true edge beside them", true, false, wrong_outside_band},
        {"acne_outside_band", "fraction", "those of them that are lit and shown dark: surfaces that shadow themselves", true, false,
            acne_outside_band},
        {"leak_outside_band", "fraction", "those of them that are dark and shown lit: shadows lost or come off their casters", true, false,
            leak_outside_band},
        {"contact_gap", "pixels", "mean width of what is lost of a shadow, along rows and columns", true, false, contact_gap},
        {"edge_displacement", "pixels", "mean distance between the shadow's edge and the true one", true, false, edge_displacement},
        {"mae", "visibility", "mean absolute error", true, true, mae},
        {"rms", "visibility", "root of the mean squared error", true, true, rms},
        {"max", "visibility", "largest absolute error", true, true, max_error},
        {"bias", "visibility", "mean of test - truth: above 0 is too light", true, true, bias},
        {"bias_penumbra", "visibility", "bias within the true penumbra: its softness is wrong", false, true, bias_penumbra},
        {"bias_outside", "visibility", "bias outside of the true penumbra", false, true, bias_outside},
        {"penumbra_width", "fraction", "how far the penumbrae's widths are from the true ones", false, true, penumbra_width},
        {"banding", "visibility", "bends and steps of the error within the true penumbra", false, true, banding},
        {"grain", "visibility", "what single pixels stray from the error around them, within the true penumbra", false, true, grain},
        {"noise", "visibility", "standard error of the truth: smaller differences say nothing", false, true, noise},
    };
    return all;
}

std::map<std::string, double> measure(const Comparison& c)
{
    std::map<std::string, double> result;
    for (const Metric& m : metrics())
        if (c.hard ? m.hard : m.soft) result.emplace(m.id, m.measure(c));
    return result;
}

} // namespace gnomon::metrics
