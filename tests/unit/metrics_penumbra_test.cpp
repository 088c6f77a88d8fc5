// SPDX-License-Identifier: Apache-2.0
#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace gnomon;
using base::Picture;
using base::Size;

namespace {

constexpr Size size{96, 40};

/// Dark to lit along x over `width` pixels about `edge`; `levels` > 0: in so many steps.
Picture ramp(float edge, float width, int levels = 0)
{
    Picture p(size, 1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float v = std::clamp(0.5f + (float(x) + 0.5f - edge) / width, 0.0f, 1.0f);
            p.at(x, y, 0) = levels > 0 ? std::floor(v * float(levels) + 0.5f) / float(levels) : v;
        }
    return p;
}

double measured(const char* id, const Picture& test, const Picture& truth, const std::vector<uint8_t>& mask)
{
    const Picture no_variance;
    return metrics::measure({test, truth, no_variance, mask, false}).at(id);
}

double measured(const char* id, const Picture& test, const Picture& truth)
{
    return measured(id, test, truth, std::vector<uint8_t>(size.area(), 1));
}

} // namespace

TEST(PenumbraMetrics, widths_are_compared_where_the_edges_are_a_little_apart)
{
    const Picture truth = ramp(48, 20);
    EXPECT_NEAR(measured("penumbra_width", ramp(48, 40), truth), 1.0, 1e-4); // 32 pixels in place of 16
    EXPECT_NEAR(measured("penumbra_width", ramp(52, 40), truth), 1.0, 1e-4);
    EXPECT_NEAR(measured("penumbra_width", ramp(44, 10), truth), 0.5, 1e-4);
    EXPECT_NEAR(measured("penumbra_width", ramp(52, 20), truth), 0.0, 1e-4);
}

TEST(PenumbraMetrics, a_hard_edge_is_a_pixel_wide)
{
    EXPECT_NEAR(measured("penumbra_width", ramp(48, 1e-3f), ramp(48, 20)), 15.0 / 16.0, 1e-4);
}

TEST(PenumbraMetrics, a_penumbra_without_a_counterpart_is_wholly_wrong)
{
    const Picture truth = ramp(48, 20);
    EXPECT_EQ(measured("penumbra_width", Picture(size, 1), truth), 1.0);
    EXPECT_EQ(measured("penumbra_width", ramp(90, 4), truth), 1.0); // too far away
    Picture turned = truth;
    for (float& v : turned.values) v = 1.0f - v;
    EXPECT_EQ(measured("penumbra_width", turned, truth), 1.0);
}

TEST(PenumbraMetrics, profiles_end_at_pixels_that_are_not_scored)
{
    const Picture truth = ramp(48, 20);
    std::vector<uint8_t> mask(size.area(), 1);
    for (int y = 0; y < size.height; ++y) mask[size_t(y) * size_t(size.width) + 52] = 0; // before 90 % are reached
    EXPECT_EQ(measured("penumbra_width", ramp(48, 40), truth, mask), 0.0);
}

TEST(PenumbraMetrics, steps_are_banding_and_no_grain)
{
    const Picture truth = ramp(48, 64);
    const double eight = measured("banding", ramp(48, 64, 8), truth), sixteen = measured("banding", ramp(48, 64, 16), truth);
    // along x the error falls by 1/64 a pixel and jumps up by 1/8 less that every eighth; along y nothing changes
    EXPECT_GT(eight, 0.3 * (1.0 / 64.0));
    EXPECT_LT(eight, 1.0 / 64.0);
    EXPECT_LT(sixteen, eight);
    EXPECT_LT(measured("grain", ramp(48, 64, 8), truth), 0.02);
    EXPECT_LT(measured("banding", ramp(48, 80), truth), 0.2 * eight) << "a smooth error is none";
}

TEST(PenumbraMetrics, noise_is_grain_more_than_banding)
{
    const Picture truth = ramp(48, 64);
    Picture noisy = truth;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> between(-0.1f, 0.1f);
    for (float& v : noisy.values) v += between(random);
    EXPECT_NEAR(measured("grain", noisy, truth), 0.05, 0.005); // half the amplitude's mean, about a median near 0
    // without the median a second difference of this noise is 0.113 on average: sqrt(6) deviations of 0.058, times sqrt(2 / pi)
    EXPECT_LT(measured("banding", noisy, truth), 0.15 * 0.113);
}
