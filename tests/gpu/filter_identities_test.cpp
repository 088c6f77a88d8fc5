// SPDX-License-Identifier: Apache-2.0
// Bounds from moments (variance, layered variance, moment maps), on single windows of depths: against closed forms, and against dense
// percentage-closer filtering, the fraction of the window's depths that are not nearer than the receiver.
#include "filter_identities.h"

namespace gnomon {
namespace {

TEST_F(FilterIdentities, VarianceIsExactForTwoDepths)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 2000; ++i) {
        const float d = 0.05f + 1.9f * unit(random), a = -1.0f + (2.0f - d) * unit(random);
        add(two_depths(a, a + d, float(1 + random() % 63) / 64.0f), a + d);
    }
    run();
    for (size_t i = 0; i < cases_.size(); ++i) {
        // The variance is off by up to ten roundings of numbers up to 1, and the bound, V / (V + (t - m)^2), by that over d^2.
        const double d = double(windows_[i][1].x - windows_[i][0].x);
        ASSERT_NEAR(double(results_[i].vsm), lit_[i], 10 * unit_roundoff / (d * d)) << i;
    }
}

TEST_F(FilterIdentities, VarianceBleedsAsItsClosedFormSays)
{
    // The fraction q at a, the rest d behind, the receiver e behind that: all in shadow, but for Chebyshev.
    struct Expected {
        float q, e_over_d, bleed;
    };
    const Expected table[] = {{0.5f, 0.1f, 0.410f}, {0.5f, 0.5f, 0.2f}, {0.5f, 1.0f, 0.1f}, {0.5f, 2.0f, 0.0385f}};
    const float a = -0.7f, d = 0.4f;
    for (const Expected& e : table) add(two_depths(a, a + d, e.q), a + d + e.e_over_d * d);
    std::mt19937 random(2);
    for (int i = 0; i < 500; ++i) add(two_depths(a, a + d, float(1 + random() % 63) / 64.0f), a + d + float(1 + random() % 200) * 0.005f);
    run();
    for (size_t i = 0; i < std::size(table); ++i) EXPECT_NEAR(results_[i].vsm, table[i].bleed, 0.0005f) << i; // three digits
    for (size_t i = 0; i < cases_.size(); ++i) {
        const double q = double(windows_[i][0].y), near = double(a), step = double(a + d) - near, e = double(cases_[i].t) - double(a + d);
        const double variance = q * (1 - q) * step * step, past_mean = e + q * step;
        ASSERT_NEAR(double(results_[i].vsm), variance / (variance + past_mean * past_mean), 10 * unit_roundoff / (step * step)) << i;
    }
}

TEST_F(FilterIdentities, BoundsAreNeverBelowTheExactFraction)
{
    std::mt19937 random(3);
    WindowCase c;
    c.moment_bias = 1e-5f, c.layers = 3, c.overlap = 0.1f;
    for (int i = 0; i < 20000; ++i) {
        c.exponent = i % 2 ? 40.0f : 80.0f;
        const Depths depths = random_depths(random);
        add(depths, random_receiver(depths, random), c);
    }
    run();
    // The least variance here is that of 1/64 at a tenth of the half range from the others, 1.5e-4. Four roundings of numbers up to 1 are
    // 1.6e-3 of it, and a quarter of that is the most by which V / (V + d^2) may be off; but windows whose mean is 0 round less.
    const double allowed = 1e-4;
    EXPECT_LT(worst_below(&WindowResult::vsm), allowed);
    EXPECT_LT(worst_below(&WindowResult::lvsm), allowed);
    EXPECT_LT(worst_below(&WindowResult::evsm2), allowed);
    EXPECT_LT(worst_below(&WindowResult::evsm4), allowed);
    // the bias is a share of another distribution, so that as much of the fraction may be missing
    EXPECT_LT(worst_below(&WindowResult::msm), allowed + 1e-5);
    EXPECT_LT(worst_below(&WindowResult::msm_quantised), allowed + 1e-5);
    // drivers' exp and log: 2^-21 relative, of exponents up to 80
    EXPECT_LT(worst_below(&WindowResult::esm), 80 * 0x1p-21);
    EXPECT_LT(worst_below(&WindowResult::esm_log), 80 * 0x1p-21);
}

TEST_F(FilterIdentities, MomentsAreExactForTwoDepthsUpToTheirBias)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    WindowCase c;
    for (const float bias : {1e-6f, 1e-5f, 1e-4f, 1e-3f})
        for (int i = 0; i < 4000; ++i) {
            c.moment_bias = bias;
            const float d = 0.2f + 1.7f * unit(random), a = -1.0f + (2.0f - d) * unit(random);
            add(two_depths(a, a + d, float(1 + random() % 63) / 64.0f), i % 4 == 3 ? a : a + d, c);
        }
    run();
    for (size_t i = 0; i < cases_.size(); ++i) {
        // What is mixed in has a second moment of 0.628: it moves the fraction by its own share, and by that of its variance to d^2.
        const double d = double(windows_[i][1].x - windows_[i][0].x);
        const double allowed = double(cases_[i].moment_bias) * (1.0 + 0.628 / (d * d)) + 2e-6; // and rounding
        const std::string what
            = "case " + std::to_string(i) + ": " + std::to_string(d) + " apart, bias " + std::to_string(cases_[i].moment_bias);
        ASSERT_NEAR(double(results_[i].msm), lit_[i], allowed) << what;
        ASSERT_NEAR(double(results_[i].msm_quantised), lit_[i], allowed) << what;
    }
}

TEST_F(FilterIdentities, BasisForFixedPointGivesMomentsBack)
{
    std::mt19937 random(5);
    for (float t = -1.0f; t <= 1.0f; t += 1.0f / 512.0f) add({{t, 1.0f}}, 0.0f);
    for (int i = 0; i < 2000; ++i) add(random_depths(random), 0.0f);
    run();
    vec4 least(1), greatest(0);
    for (const WindowResult& r : results_) {
        for (int k = 0; k < 4; ++k) ASSERT_NEAR(r.returned[k], r.moments[k], 1e-6f); // some ten roundings of numbers up to 1
        least = glm::min(least, r.quantised), greatest = glm::max(greatest, r.quantised);
    }
    for (int k = 0; k < 4; ++k) { // every channel fills [0, 1]
        EXPECT_NEAR(least[k], 0.0f, 1e-5f) << k; // depths here come within 1/1024 of where the polynomials turn
        EXPECT_NEAR(greatest[k], 1.0f, 1e-5f) << k;
        EXPECT_GE(least[k], -3e-7f) << k; // five roundings
        EXPECT_LE(greatest[k], 1.0f + 3e-7f) << k;
    }
}

/// A window with one depth is lit for a receiver on it, though rounding puts the receiver a little behind.
TEST_F(FilterIdentities, FlatWindowsForgiveRounding)
{
    WindowCase c;
    c.min_deviation = 1e-3f, c.moment_bias = 1e-5f; // the techniques' defaults
    for (float z = -0.99f; z < 0.99f; z += 0.01f) add({{z, 1.0f}}, z + 1e-6f, c);
    run();
    for (const WindowResult& r : results_) {
        // (d / deviation)^2 is 1e-6, and roundings of the variance, 1e-6, by 1e-7 hardly matter
        EXPECT_GT(r.vsm, 0.9999f);
        EXPECT_GT(r.lvsm, 0.9999f);
        // the warp's own rounding at an exponent of 40 is that of depth times 20
        EXPECT_GT(r.evsm4, 0.999f);
        EXPECT_GT(r.msm, 0.999f);
        EXPECT_GT(r.esm, 0.9999f);
        EXPECT_EQ(r.power, 1.0f);
    }
}

TEST_F(FilterIdentities, LayersConvergeWhereTheReceiverIsTheFarthest)
{
    std::mt19937 random(9);
    const size_t windows = 2000;
    WindowCase c;
    for (const int layers : {1, 2, 4, 8, 16, 32, 64})
        for (size_t i = 0; i < windows; ++i) {
            c.layers = layers;
            const Depths depths = random_depths(random);
            add(depths, std::ranges::max_element(depths, {}, &vec2::x)->x, c);
        }
    run();
    double before = mean_error(&WindowResult::lvsm, 0, windows);
    EXPECT_GT(before, 0.1);
    for (size_t k = 1; k < 7; ++k) {
        const double error = mean_error(&WindowResult::lvsm, k * windows, (k + 1) * windows);
        EXPECT_LT(error, 0.8 * before) << cases_[k * windows].layers << " layers";
        before = error;
    }
}

/// Depths that have a layer each: the layer's moments see all nearer depths as 0, and there are two values for Chebyshev. With farther
/// depths, which it sees as 1, there would be three, and the bound would stay above the fraction with any number of layers.
TEST_F(FilterIdentities, LayersAreExactForDepthsThatDoNotShareThem)
{
    std::mt19937 random(10);
    std::uniform_real_distribution<float> unit(0.1f, 0.9f);
    WindowCase c;
    for (const int layers : {2, 4, 8, 16, 32, 64})
        for (int i = 0; i < 500; ++i) {
            c.layers = layers;
            Depths depths;
            for (int k = 0; k < layers; ++k)
                if (k == layers / 2 || random() % 2) depths.emplace_back(-1.0f + 2.0f * (float(k) + unit(random)) / float(layers), 0.0f);
            for (int k = 0; k < 64; ++k) depths[random() % depths.size()].y += 1.0f / 64.0f;
            add(depths, depths.back().x, c);
        }
    run();
    for (size_t i = 0; i < cases_.size(); ++i) {
        // Warped depth is 0.1 at least; rounded at 2^-24 of the range, which is as many layers.
        ASSERT_NEAR(double(results_[i].lvsm), lit_[i], 10 * double(cases_[i].layers) * unit_roundoff / 0.01) << i;
    }
}

TEST_F(FilterIdentities, ABoundaryBetweenTwoOccludersEndsBleeding)
{
    // Occluders at a and b, the receiver behind both. Without a boundary between them it is VSM's bleeding.
    WindowCase c;
    for (const int layers : {1, 2}) {
        c.layers = layers;
        add(two_depths(-0.4f, 0.2f, 0.5f), 0.5f, c);
    }
    run();
    EXPECT_NEAR(results_[0].lvsm, results_[0].vsm, 1e-5f); // the warp is linear
    EXPECT_NEAR(results_[0].vsm, 0.2f, 1e-5f);
    // one layer behind the boundary: half at 0, half at 0.2, the receiver at 0.5
    EXPECT_NEAR(results_[1].lvsm, 0.01 / (0.01 + 0.4 * 0.4), 1e-5);
}

} // namespace
} // namespace gnomon
