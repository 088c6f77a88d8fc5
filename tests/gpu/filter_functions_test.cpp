// SPDX-License-Identifier: Apache-2.0
// Maps of functions of depth (exponential, convolution, power-function maps), on single windows of depths: against closed forms, and
// against dense percentage-closer filtering, the fraction of the window's depths that are not nearer than the receiver.
#include "filter_identities.h"

namespace gnomon {
namespace {

class FilterFunctions : public FilterIdentities { };

TEST_F(FilterFunctions, ExponentialsBleedLessThanVariance)
{
    // Half of the window at 0.2 of the depth range, half at 0.5, the receiver at 0.6: all in shadow.
    const Depths depths = two_depths(-0.6f, 0.0f, 0.5f);
    WindowCase c;
    for (const float exponent : {5.0f, 10.0f, 20.0f, 40.0f}) {
        c.exponent = c.negative_exponent = exponent;
        add(depths, 0.2f, c);
    }
    run();
    EXPECT_NEAR(results_[0].vsm, 0.265f, 0.0005f);
    const float expected[] = {0.123f, 0.045f, 0.005f}; // three digits
    for (size_t i = 0; i < std::size(expected); ++i) EXPECT_NEAR(results_[i].evsm4, expected[i], 0.0005f) << i;
    for (size_t i = 0; i < results_.size(); ++i) {
        const auto bound = [](double w1, double w2, double at) { // Chebyshev's, of half at w1 and half at w2
            const double variance = 0.25 * (w2 - w1) * (w2 - w1), past_mean = at - 0.5 * (w1 + w2);
            return variance / (variance + past_mean * past_mean);
        };
        const double e = double(cases_[i].exponent);
        const double positive = bound(std::exp(0.2 * e), std::exp(0.5 * e), std::exp(0.6 * e));
        const double negative = bound(-std::exp(-0.2 * e), -std::exp(-0.5 * e), -std::exp(-0.6 * e));
        // exp of arguments up to 8 carries 2^-21, and the variance is half of what is subtracted
        EXPECT_NEAR(double(results_[i].evsm2), positive, 2e-5);
        EXPECT_NEAR(double(results_[i].evsm4), std::min(positive, negative), 2e-5);
    }
}

TEST_F(FilterFunctions, ExponentialsLeakByTheDepthToTheOccluder)
{
    // A fraction p at the receiver, the rest d of the range nearer: p + (1 - p) exp(-c d).
    WindowCase c;
    for (const float exponent : {5.0f, 20.0f, 80.0f, 160.0f})
        for (const float d : {0.01f, 0.05f, 0.2f, 0.5f})
            for (const float p : {0.0f, 0.25f, 0.5f, 0.984375f}) {
                c.exponent = exponent;
                add({{0.3f, p}, {0.3f - 2.0f * d, 1.0f - p}}, 0.3f, c);
            }
    run();
    for (size_t i = 0; i < cases_.size(); ++i) {
        const double p = double(windows_[i][0].y), d = 0.5 * double(windows_[i][0].x - windows_[i][1].x), e = double(cases_[i].exponent);
        const double expected = p + (1 - p) * std::exp(-e * d);
        ASSERT_NEAR(double(results_[i].esm), expected, 160 * 0x1p-21) << i; // drivers' exp: 2^-21 relative, of exponents up to 160
        if (e * d > 15) {
            EXPECT_NEAR(double(results_[i].esm), p, 1e-4) << i;
        }
    }
}

TEST_F(FilterFunctions, LogarithmsGiveTheSameExponentials)
{
    std::mt19937 random(6);
    WindowCase c;
    for (int i = 0; i < 4000; ++i) {
        const Depths depths = random_depths(random);
        c.exponent = i % 2 ? 20.0f : 160.0f;
        add(depths, random_receiver(depths, random), c);
    }
    run();
    for (size_t i = 0; i < cases_.size(); ++i) ASSERT_NEAR(results_[i].esm, results_[i].esm_log, 160 * 0x1p-21f) << i;
}

TEST_F(FilterFunctions, FourierSeriesOfAStep)
{
    // Largest value of the series' partial sums beside a single step, less 1 (the Gibbs phenomenon).
    const std::pair<int, float> table[] = {{2, 0.100f}, {4, 0.092f}, {8, 0.090f}, {16, 0.090f}};
    const float far = 0.99f;
    const int steps = 4000;
    WindowCase c;
    for (const auto& [terms, overshoot] : table)
        for (int i = 0; i < steps; ++i) {
            c.terms = terms;
            add({{far, 1.0f}}, far - 1.99f * float(i) / float(steps), c);
        }
    run();
    for (size_t k = 0; k < std::size(table); ++k) {
        const auto begin = results_.begin() + std::ptrdiff_t(k) * steps;
        EXPECT_NEAR(begin->csm, 0.5f, 1e-6f) << "on the step";
        const float greatest = std::max_element(begin, begin + steps, [](auto& a, auto& b) { return a.csm < b.csm; })->csm;
        EXPECT_NEAR(greatest - 1.0f, table[k].second, 0.0006f) << table[k].first << " terms"; // three digits
    }
}

TEST_F(FilterFunctions, FourierSeriesConvergesToTheExactFraction)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> centred(-1.0f, 1.0f);
    const size_t windows = 4000;
    WindowCase c;
    for (const int terms : {2, 4, 8, 16})
        for (size_t i = 0; i < windows; ++i) {
            c.terms = terms;
            add(random_depths(random), centred(random), c); // never on a depth, where the series gives 1/2 however long it is
        }
    run();
    double before = mean_error(&WindowResult::csm, 0, windows);
    EXPECT_LT(before, 0.12);
    for (size_t k = 1; k < 4; ++k) {
        const double error = mean_error(&WindowResult::csm, k * windows, (k + 1) * windows);
        EXPECT_LT(error, 0.75 * before) << cases_[k * windows].terms << " terms";
        before = error;
    }
}

TEST_F(FilterFunctions, BitsOfFourierTermsAddUp)
{
    std::mt19937 random(8);
    WindowCase c;
    for (int i = 0; i < 8000; ++i) {
        const Depths depths = random_depths(random);
        const float t = random_receiver(depths, random);
        c.terms = 2 << (i % 4);
        for (const int bits : {0, 8, 16}) {
            c.bits = bits;
            add(depths, t, c);
        }
    }
    run();
    for (size_t i = 0; i < cases_.size(); i += 3) {
        // A sine and a cosine are half a step off after storing and another half after averaging, which 2 x - 1 doubles. A term is
        // 2 / c_k times their sum under weights cos and sin, whose magnitudes add up to at most sqrt 2.
        double weight = 0;
        for (int k = 1; k <= cases_[i].terms; ++k) weight += 2.0 / (3.14159265358979 * (2 * k - 1)) * std::sqrt(2.0);
        ASSERT_NEAR(results_[i + 1].csm, results_[i].csm, 2.0 / 255.0 * weight + 2e-6) << i;
        ASSERT_NEAR(results_[i + 2].csm, results_[i].csm, 2.0 / 65535.0 * weight + 2e-6) << i;
    }
}

TEST_F(FilterFunctions, PowerFunctionFitsPowerLaws)
{
    const int n = 4096;
    for (const double power : {0.25, 0.5, 1.0, 2.0, 5.0}) {
        Depths depths = {{-0.5f, 0.0f}, {0.7f, 0.0f}}; // the ends of the range, where no quantile lies
        for (int i = 0; i < n; ++i) depths.emplace_back(float(-0.5 + 1.2 * std::pow((i + 0.5) / n, 1.0 / power)), 1.0f / float(n));
        for (float t = -0.6f; t < 0.8f; t += 0.01f) add(depths, t);
    }
    run();
    // The fraction of n depths is known to 1 / n; the fitted power from a mean with n roundings, of which most cancel.
    for (size_t i = 0; i < cases_.size(); ++i) ASSERT_NEAR(double(results_[i].power), lit_[i], 2.0 / n) << i;
}

} // namespace
} // namespace gnomon
