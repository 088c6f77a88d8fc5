// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/image_file.h"
#include "metrics/flip_color.h"
#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace gnomon;
using base::Picture;
using base::Size;

namespace {

constexpr Size size{96, 64};

Picture plain(float r, float g, float b, Size s = size)
{
    Picture p(s, 3);
    for (size_t i = 0; i < s.area(); ++i) p.values[3 * i] = r, p.values[3 * i + 1] = g, p.values[3 * i + 2] = b;
    return p;
}

Picture noise(unsigned seed)
{
    std::mt19937 random(seed);
    Picture p(size, 3);
    for (float& v : p.values) v = float(random() & 0xffff) / 65535.0f;
    return p;
}

Picture step(float edge, float blur)
{
    Picture p(size, 1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) p.at(x, y) = 1.0f / (1.0f + std::exp(-(float(x) - edge) / std::max(blur, 1e-3f)));
    return p;
}

} // namespace

TEST(Flip, colour_spaces_match_published_values_and_invert)
{
    // CIELab of the sRGB primaries under D65, then Hunt: a and b times L / 100.
    const metrics::Color green = metrics::hunt_lab({0, 1, 0}), blue = metrics::hunt_lab({0, 0, 1});
    EXPECT_NEAR(green[0], 87.737f, 0.01f);
    EXPECT_NEAR(green[1], -86.183f * 0.87737f, 0.02f);
    EXPECT_NEAR(green[2], 83.180f * 0.87737f, 0.02f);
    EXPECT_NEAR(blue[0], 32.303f, 0.01f);
    EXPECT_NEAR(blue[1], 79.197f * 0.32303f, 0.02f);
    EXPECT_NEAR(blue[2], -107.864f * 0.32303f, 0.02f);
    EXPECT_NEAR(metrics::hyab(metrics::hunt_lab({1, 1, 1}), metrics::hunt_lab({0, 0, 0})), 100.0, 1e-3);
    for (const metrics::Color& c : {metrics::Color{0.2f, 0.5f, 0.9f}, {1, 1, 1}, {0, 0, 0}, {1, 0, 0.25f}}) {
        const metrics::Color back = metrics::rgb_from_ycxcz(metrics::ycxcz(c));
        for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], c[k], 1e-5f);
    }
}

TEST(Flip, plain_pictures_have_the_closed_form)
{
    // No features: only the colour pipeline. Black to white: HyAB = 100, the largest (green to blue) = 203.2 from the values above;
    // 0.95 + (100^0.7 - 0.4 * 203.2^0.7) / (0.6 * 203.2^0.7) * 0.05 = 0.968.
    EXPECT_NEAR(metrics::flip(plain(0, 0, 0), plain(1, 1, 1)), 0.968, 0.002);
    EXPECT_NEAR(metrics::flip(plain(0, 1, 0), plain(0, 0, 1)), 1.0, 1e-5);
    EXPECT_EQ(metrics::flip(plain(0.3f, 0.4f, 0.5f), plain(0.3f, 0.4f, 0.5f)), 0.0);
    // The linear part of the curve: L = 116 cbrt(y) - 16.
    const double difference = 116 * (std::cbrt(0.5) - std::cbrt(0.45));
    EXPECT_NEAR(metrics::flip(plain(0.5f, 0.5f, 0.5f), plain(0.45f, 0.45f, 0.45f)), 0.95 / 0.4 * std::pow(difference / 203.2, 0.7), 0.002);
}

TEST(Flip, is_zero_symmetric_and_bounded)
{
    const Picture a = noise(1), b = noise(2);
    EXPECT_EQ(metrics::flip(a, a), 0.0);
    Picture map;
    const double ab = metrics::flip(a, b, &map);
    EXPECT_NEAR(ab, metrics::flip(b, a), 1e-6);
    EXPECT_GT(ab, 0.05);
    EXPECT_GE(*std::min_element(map.values.begin(), map.values.end()), 0.0f);
    EXPECT_LE(*std::max_element(map.values.begin(), map.values.end()), 1.0f);
    double sum = 0;
    for (const float v : map.values) sum += double(v);
    EXPECT_NEAR(sum / double(map.values.size()), ab, 1e-5);
}

TEST(Flip, grows_with_blur_and_with_displacement)
{
    const Picture sharp = step(48, 0);
    double last = 0.0;
    for (const float blur : {0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
        const double f = metrics::flip(step(48, blur), sharp);
        EXPECT_GT(f, last) << blur;
        last = f;
    }
    last = 0.0;
    for (const float shift : {1.0f, 2.0f, 4.0f, 8.0f}) {
        const double f = metrics::flip(step(48 + shift, 0), sharp);
        EXPECT_GT(f, last) << shift;
        last = f;
    }
}

TEST(Flip, finds_the_error_where_it_is_and_sees_less_from_afar)
{
    Picture a = plain(0.5f, 0.5f, 0.5f), b = a;
    for (int y = 28; y < 32; ++y)
        for (int x = 40; x < 44; ++x)
            for (int c = 0; c < 3; ++c) b.at(x, y, c) = 1.0f;
    Picture map;
    const double near = metrics::flip(a, b, &map, 30.0f), far = metrics::flip(a, b, nullptr, 200.0f);
    EXPECT_GT(map.at(42, 30), 0.3f);
    EXPECT_LT(map.at(5, 5), 1e-3f);
    EXPECT_LT(map.at(90, 60), 1e-3f);
    EXPECT_GT(metrics::flip(a, b, nullptr, 30.0f), 0.0);
    EXPECT_NE(near, far);
    Picture fine_a = plain(0.5f, 0.5f, 0.5f), fine_b = fine_a;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) fine_b.at(x, y, c) = (x + y) % 2 ? 0.6f : 0.4f;
    EXPECT_LT(metrics::flip(fine_a, fine_b, nullptr, 200.0f), 0.5 * metrics::flip(fine_a, fine_b, nullptr, 10.0f))
        << "a pattern of 100 cycles a degree melts into grey";
}

TEST(Flip, takes_any_size_and_refuses_unlike_pictures)
{
    for (const Size s : {Size{1, 1}, Size{3, 200}}) EXPECT_NEAR(metrics::flip(plain(0, 0, 0, s), plain(1, 1, 1, s)), 0.968, 0.002);
    Picture bad = plain(0, 0, 0);
    bad.values[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(metrics::flip(bad, plain(0, 0, 0)), 0.0);
    EXPECT_THROW(metrics::flip(plain(0, 0, 0), plain(0, 0, 0, {2, 2})), base::Error);
    EXPECT_THROW(metrics::flip(Picture(size, 2), Picture(size, 2)), base::Error);
    EXPECT_THROW(metrics::flip(plain(0, 0, 0), plain(0, 0, 0), nullptr, 0.0f), base::Error);
}

TEST(HeatMap, shows_sign_mask_and_a_legend)
{
    Picture test(size, 1, 0.5f), truth(size, 1, 0.5f), variance;
    std::vector<uint8_t> mask(size.area(), 1);
    for (int y = 0; y < size.height; ++y) {
        test.at(1, y) = 0.1f;
        test.at(2, y) = 0.9f;
        mask[size_t(y) * size_t(size.width) + 3] = 0;
    }
    const Picture map = metrics::signed_heat_map({test, truth, variance, mask, false});
    EXPECT_EQ(map.size.width, size.width);
    EXPECT_GT(map.size.height, size.height);
    const auto at = [&](int x, int c) { return map.at(x, 10, c); };
    EXPECT_EQ(at(0, 0) + at(0, 1) + at(0, 2), 3.0f) << "equal is white";
    EXPECT_GT(at(1, 2), at(1, 0)) << "too dark is blue";
    EXPECT_GT(at(2, 0), at(2, 2)) << "too light is red";
    EXPECT_EQ(at(3, 0), at(3, 2)) << "not scored is grey";
    EXPECT_LT(at(3, 0), 0.9f);
    // The legend's ends have the colours of the range's ends.
    const int row = size.height + 8;
    EXPECT_GT(map.at(12, row, 2), map.at(12, row, 0));
    EXPECT_GT(map.at(size.width - 13, row, 0), map.at(size.width - 13, row, 2));
    // A tenth of the range is seen: the colours are not lost in white.
    EXPECT_LT(metrics::signed_heat_map({Picture(size, 1, 0.6f), truth, variance, mask, false}).at(0, 0, 2), 0.9f);
    for (const Size s : {Size{1, 1}, Size{20, 3}, Size{700, 2}}) {
        const std::vector<uint8_t> one(s.area(), 1);
        const Picture small = metrics::signed_heat_map({Picture(s, 1), Picture(s, 1), variance, one, true}, 0.1f);
        EXPECT_TRUE(std::all_of(small.values.begin(), small.values.end(), [](float v) { return v >= 0.0f && v <= 1.0f; }));
    }
}
