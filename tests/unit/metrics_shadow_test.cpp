// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gnomon;
using base::Picture;
using base::Size;

namespace {

constexpr Size size{64, 48};
const Picture no_variance;

/// Lit (1) where x >= edge; a ramp of `soft` pixels.
Picture half(float edge, float soft = 0.0f, int channels = 1)
{
    Picture p(size, channels);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < channels; ++c) {
                const float d = float(x) + 0.5f - edge;
                p.at(x, y, c) = soft > 0.0f ? std::clamp(0.5f + d / soft, 0.0f, 1.0f) : d > 0.0f ? 1.0f : 0.0f;
            }
    return p;
}

std::vector<uint8_t> all() { return std::vector<uint8_t>(size.area(), 1); }

std::map<std::string, double> measure(const Picture& test, const Picture& truth, bool hard, const std::vector<uint8_t>& mask = all())
{
    return metrics::measure({test, truth, no_variance, mask, hard});
}

/// `share` of the pixels on one side of x = 32 get `value`, in stripes.
Picture striped(bool lit_side, float value, int period)
{
    Picture p = half(32);
    for (int y = 0; y < size.height; y += period)
        for (int x = 0; x < size.width; ++x)
            if ((x >= 32) == lit_side) p.at(x, y) = value;
    return p;
}

} // namespace

TEST(Metrics, equal_pictures_have_no_error)
{
    for (const bool hard : {true, false}) {
        const Picture p = half(20, hard ? 0.0f : 8.0f);
        for (const auto& [id, value] : measure(p, p, hard)) EXPECT_EQ(value, 0.0) << id;
    }
}

TEST(Metrics, every_metric_says_for_which_lights_it_is)
{
    const Picture p = half(20);
    const auto hard = measure(p, p, true), soft = measure(p, p, false);
    for (const char* id :
        {"wrong_pixels", "wrong_outside_band", "acne_outside_band", "leak_outside_band", "contact_gap", "edge_displacement"}) {
        EXPECT_TRUE(hard.contains(id)) << id;
        EXPECT_FALSE(soft.contains(id)) << id;
    }
    for (const char* id : {"bias_penumbra", "bias_outside", "noise"}) {
        EXPECT_FALSE(hard.contains(id)) << id;
        EXPECT_TRUE(soft.contains(id)) << id;
    }
    for (const char* id : {"acne", "leak", "mae", "rms", "max", "bias"}) EXPECT_TRUE(hard.contains(id) && soft.contains(id)) << id;
    for (const metrics::Metric& m : metrics::metrics()) EXPECT_FALSE(m.help.empty() || m.unit.empty()) << m.id;
}

TEST(Metrics, a_shifted_edge_is_measured_in_pixels)
{
    for (const int shift : {1, 3, 7}) {
        const auto m = measure(half(20.0f + float(shift)), half(20), true);
        EXPECT_DOUBLE_EQ(m.at("edge_displacement"), shift);
        EXPECT_DOUBLE_EQ(m.at("wrong_pixels"), double(shift) / size.width);
        EXPECT_DOUBLE_EQ(m.at("acne"), double(shift) / size.width) << "the shadow grew";
        EXPECT_EQ(m.at("leak"), 0.0);
        EXPECT_DOUBLE_EQ(m.at("wrong_outside_band"), double(shift - 1) / size.width);
        EXPECT_LT(m.at("bias"), 0.0);
    }
    // A slanted edge moved along x by 5: the nearest point is at 5 sin(45 degrees), up to the grid.
    Picture a(size, 1), b(size, 1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) a.at(x, y) = x > y, b.at(x, y) = x > y + 5;
    EXPECT_NEAR(measure(a, b, true).at("edge_displacement"), 5.0 / std::sqrt(2.0), 0.4);
}

TEST(Metrics, a_lost_or_invented_shadow_has_the_largest_displacement)
{
    const Picture lit(size, 1, 1.0f), edge = half(20);
    EXPECT_EQ(measure(lit, edge, true).at("edge_displacement"), 32.0);
    EXPECT_EQ(measure(edge, lit, true).at("edge_displacement"), 32.0);
    EXPECT_EQ(measure(lit, lit, true).at("edge_displacement"), 0.0);
}

TEST(Metrics, acne_and_leaks_are_told_apart_and_ranked)
{
    const Picture truth = half(32);
    double last = 1.0;
    for (const int period : {2, 4, 8}) {
        const auto acne = measure(striped(true, 0.0f, period), truth, true), leak = measure(striped(false, 1.0f, period), truth, true);
        EXPECT_DOUBLE_EQ(acne.at("acne"), 0.5 / period);
        EXPECT_EQ(acne.at("leak"), 0.0);
        EXPECT_DOUBLE_EQ(leak.at("leak"), 0.5 / period);
        EXPECT_EQ(leak.at("acne"), 0.0);
        EXPECT_LT(acne.at("acne"), last);
        last = acne.at("acne");
        // Only the columns beside the edge are excused.
        EXPECT_DOUBLE_EQ(acne.at("wrong_outside_band"), 31.0 / 64 / period);
    }
    const auto soft = measure(striped(true, 0.8f, 4), truth, false), faint = measure(striped(true, 0.95f, 4), truth, false);
    EXPECT_DOUBLE_EQ(soft.at("acne"), 0.125);
    EXPECT_EQ(faint.at("acne"), 0.0) << "a slight dimming is bias, not acne";
    EXPECT_LT(faint.at("bias_outside"), 0.0);
    EXPECT_DOUBLE_EQ(measure(striped(false, 0.2f, 4), truth, false).at("leak"), 0.125);
    EXPECT_EQ(measure(striped(false, 0.05f, 4), truth, false).at("leak"), 0.0);
}

TEST(Metrics, acne_and_leaks_away_from_edges_add_up_to_what_is_wrong_there)
{
    const Picture truth = half(32);
    const auto acne = measure(striped(true, 0.0f, 4), truth, true), leak = measure(striped(false, 1.0f, 4), truth, true);
    EXPECT_DOUBLE_EQ(acne.at("acne_outside_band"), acne.at("wrong_outside_band"));
    EXPECT_EQ(acne.at("leak_outside_band"), 0.0);
    EXPECT_DOUBLE_EQ(leak.at("leak_outside_band"), 31.0 / 64 / 4);
    EXPECT_EQ(leak.at("acne_outside_band"), 0.0);
    EXPECT_EQ(measure(half(33), truth, true).at("acne_outside_band"), 0.0) << "an edge one pixel off is within the band";
}

TEST(Metrics, a_gap_between_shadow_and_caster_is_measured_in_pixels)
{
    // A shadow from column 10 on, 20 pixels wide, that begins some pixels late. Along each row there is one run, and it has the gap;
    // along the columns, 20 runs, those of the gap's columns wholly lit: 32 of them count.
    Picture truth(size, 1, 1.0f);
    for (int y = 0; y < size.height; ++y)
        for (int x = 10; x < 30; ++x) truth.at(x, y) = 0.0f;
    double last = 0.0;
    for (const int gap : {0, 1, 3, 6}) {
        Picture test = truth;
        for (int y = 0; y < size.height; ++y)
            for (int x = 10; x < 10 + gap; ++x) test.at(x, y) = 1.0f;
        const double got = measure(test, truth, true).at("contact_gap");
        EXPECT_DOUBLE_EQ(got, double(gap) * (size.height + 32) / (size.height + 20));
        EXPECT_TRUE(gap == 0 || got > last);
        last = got;
    }
    // Acne opens no gap, and neither does a shadow that grows.
    EXPECT_EQ(measure(striped(true, 0.0f, 4), half(32), true).at("contact_gap"), 0.0);
    EXPECT_EQ(measure(half(36), half(32), true).at("contact_gap"), 0.0);
    EXPECT_EQ(measure(Picture(size, 1), Picture(size, 1, 1.0f), true).at("contact_gap"), 0.0) << "no shadow, no gap";
    std::vector<uint8_t> none(size.area(), 0);
    EXPECT_EQ(measure(Picture(size, 1, 1.0f), truth, true, none).at("contact_gap"), 0.0);
}

TEST(Metrics, a_filtered_value_of_one_half_is_right_either_way)
{
    const Picture grey(size, 1, 0.5f);
    EXPECT_EQ(measure(grey, half(32), true).at("wrong_pixels"), 0.0);
    const Picture darker(size, 1, 0.499f);
    EXPECT_DOUBLE_EQ(measure(darker, half(32), true).at("acne"), 0.5);
}

TEST(Metrics, more_blur_is_more_error)
{
    const Picture truth = half(32);
    double last = 0.0;
    for (const float soft : {2.0f, 6.0f, 18.0f}) {
        const auto m = measure(half(32, soft), truth, true);
        EXPECT_GT(m.at("rms"), last);
        EXPECT_NEAR(m.at("bias"), 0.0, 1e-6) << "blur is symmetric";
        EXPECT_EQ(m.at("wrong_pixels"), 0.0);
        last = m.at("rms");
    }
    const Picture penumbra = half(32, 20);
    EXPECT_GT(measure(half(28, 20), penumbra, false).at("bias_penumbra"), 0.15) << "moved towards the dark: too light";
    EXPECT_NEAR(measure(half(32, 10), penumbra, false).at("bias_penumbra"), 0.0, 1e-6);
    EXPECT_GT(measure(half(32, 10), penumbra, false).at("mae"), measure(half(32, 16), penumbra, false).at("mae"));
}

TEST(Metrics, errors_have_their_textbook_values)
{
    Picture test(size, 1, 0.25f), truth(size, 1, 0.5f);
    test.at(3, 3) = 1.0f;
    const double n = double(size.area());
    const auto m = measure(test, truth, false);
    EXPECT_DOUBLE_EQ(m.at("mae"), (0.25 * (n - 1) + 0.5) / n);
    EXPECT_DOUBLE_EQ(m.at("bias"), (-0.25 * (n - 1) + 0.5) / n);
    EXPECT_DOUBLE_EQ(m.at("rms"), std::sqrt((0.0625 * (n - 1) + 0.25) / n));
    EXPECT_EQ(m.at("max"), 0.5);
    const Picture variance(size, 1, 0.0004f);
    const auto mask = all();
    EXPECT_NEAR(metrics::measure({test, truth, variance, mask, false}).at("noise"), 0.02, 1e-6);
}

TEST(Metrics, masked_pixels_do_not_count)
{
    std::vector<uint8_t> mask = all();
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % size_t(size.width) >= 25;
    const auto m = measure(half(23), half(20), true, mask);
    for (const auto& [id, value] : m) EXPECT_EQ(value, 0.0) << id;
    std::fill(mask.begin(), mask.end(), uint8_t(0));
    for (const auto& [id, value] : measure(half(23), half(20), true, mask)) EXPECT_EQ(value, 0.0) << id;
    // The border of the mask is no edge: an unscored lit background beside a dark object.
    mask = all();
    for (size_t i = 0; i < mask.size(); ++i) mask[i] = i % size_t(size.width) < 20;
    EXPECT_EQ(measure(Picture(size, 1), half(20), true, mask).at("edge_displacement"), 0.0);
}

TEST(Metrics, what_is_not_finite_is_as_wrong_as_can_be)
{
    const Picture truth = half(32);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const auto m = measure(Picture(size, 1, bad), truth, true);
        EXPECT_EQ(m.at("wrong_pixels"), 1.0);
        EXPECT_EQ(m.at("mae"), 1.0);
        EXPECT_EQ(m.at("acne"), 0.5);
    }
}

TEST(Metrics, three_channels_are_averaged)
{
    const Picture truth = half(20, 0, 3);
    Picture test = truth;
    for (size_t i = 0; i < test.values.size(); i += 3) test.values[i] = 1.0f - test.values[i];
    EXPECT_NEAR(measure(test, truth, false).at("mae"), 1.0 / 3.0, 1e-6);
    EXPECT_EQ(measure(half(23, 0, 3), truth, true).at("edge_displacement"), 3.0);
}

TEST(Metrics, errors_of_opposite_sign_do_not_cancel)
{
    const Picture truth(Picture({4, 4}, 3, 0.5f));
    Picture test = truth;
    for (size_t i = 0; i < test.values.size(); i += 3) test.values[i] += 0.3f, test.values[i + 2] -= 0.3f;
    const auto m = metrics::measure({test, truth, no_variance, std::vector<uint8_t>(16, 1)});
    EXPECT_NEAR(m.at("mae"), 0.2, 1e-6);
    EXPECT_NEAR(m.at("rms"), std::sqrt(2 * 0.09 / 3), 1e-6);
    EXPECT_NEAR(m.at("max"), 0.3, 1e-6);
    EXPECT_NEAR(m.at("bias"), 0.0, 1e-6);
}

TEST(Metrics, unlike_pictures_are_refused)
{
    EXPECT_THROW(measure(Picture({8, 8}, 1), half(20), true), base::Error);
    EXPECT_THROW(measure(half(20, 0, 3), half(20), true), base::Error);
    EXPECT_THROW(measure(half(20), half(20), true, std::vector<uint8_t>(3)), base::Error);
    EXPECT_THROW(metrics::signed_heat_map({half(20), Picture({8, 8}, 1), no_variance, all(), true}), base::Error);
}

TEST(FilterMetrics, lighter_and_darker_parts_add_up)
{
    const Picture reference = half(32, 16.0f);
    Picture test = reference;
    test.at(3, 0) += 0.5f; // dark there
    test.at(60, 0) -= 0.25f, test.at(61, 0) -= 0.25f; // lit there
    std::vector<uint8_t> mask = all();
    for (size_t i = size.area() / 2; i < mask.size(); ++i) mask[i] = 0;
    test.values.back() = 0.0f; // not scored
    const double scored = double(size.area() / 2);
    const auto m = metrics::measure_filter({test, reference, no_variance, mask});
    EXPECT_EQ(m.size(), metrics::filter_metrics().size());
    EXPECT_NEAR(m.at("filter_leak"), 0.5 / scored, 1e-9);
    EXPECT_NEAR(m.at("filter_dark"), 0.5 / scored, 1e-9);
    EXPECT_NEAR(m.at("filter_mae"), 1.0 / scored, 1e-9);
    EXPECT_NEAR(m.at("filter_bias"), 0.0, 1e-9);
    EXPECT_NEAR(m.at("filter_rms"), std::sqrt(0.375 / scored), 1e-9);
    EXPECT_NEAR(m.at("filter_max"), 0.5, 1e-6);
}

TEST(FilterMetrics, a_value_that_is_not_finite_is_the_worst)
{
    Picture test = half(32);
    test.values[0] = std::numeric_limits<float>::quiet_NaN(); // dark in the reference
    EXPECT_EQ(metrics::measure_filter({test, half(32), no_variance, all()}).at("filter_leak"), 1.0 / double(size.area()));
}
