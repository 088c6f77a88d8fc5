// SPDX-License-Identifier: Apache-2.0
// Sequences made on the CPU, whose changes are known.
#include "base/error.h"
#include "metrics/temporal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace gnomon;
using base::Picture;
using base::Size;

namespace {

constexpr Size size{96, 64};

/// A wall (z = 0) at one pixel a unit before a camera that moves along it; the truth is all lit, so that the test's darkness is the error.
struct Wall {
    using Shade = std::function<float(size_t frame, float x, float y)>; ///< the test at a point of the wall
    std::vector<std::array<float, 2>> offsets; ///< of the camera in each frame, pixels
    Shade shade;
    std::function<float(size_t frame, float x, float y)> depth = [](size_t, float, float) { return 0.0f; };
    float variance = 0.0f;
    bool fixed = false;

    metrics::Temporal measure() const
    {
        const size_t count = offsets.size();
        std::vector<Picture> tests(count, Picture(size, 1)), positions(count, Picture(size, 3)), normals(count, Picture(size, 3));
        const Picture truth(size, 1, 1.0f), widths(size, 1, 1.0f), variances(variance > 0 ? Picture(size, 1, variance) : Picture());
        const std::vector<uint8_t> mask(size.area(), 1);
        std::vector<metrics::SequenceFrame> frames;
        for (size_t t = 0; t < count; ++t) {
            for (int y = 0; y < size.height; ++y)
                for (int x = 0; x < size.width; ++x) {
                    const float u = float(x) + 0.5f + offsets[t][0], v = float(y) + 0.5f + offsets[t][1];
                    tests[t].at(x, y) = shade(t, u, v);
                    positions[t].at(x, y, 0) = u, positions[t].at(x, y, 1) = v, positions[t].at(x, y, 2) = depth(t, u, v);
                    normals[t].at(x, y, 2) = 1.0f;
                }
            frames.push_back(
                {{tests[t], truth, variances, mask, true}, positions[t], normals[t], widths, [o = offsets[t]](std::array<float, 3> p) {
                     return std::array<float, 2>{p[0] - o[0], p[1] - o[1]};
                 }});
        }
        return metrics::measure_sequence(frames, fixed);
    }
};

std::vector<std::array<float, 2>> still(size_t frames) { return std::vector<std::array<float, 2>>(frames, {0.0f, 0.0f}); }

std::vector<std::array<float, 2>> moving(size_t frames, float x, float y)
{
    std::vector<std::array<float, 2>> out;
    for (size_t t = 0; t < frames; ++t) out.push_back({float(t) * x, float(t) * y});
    return out;
}

/// A dark band `width` pixels wide along a slanted line through (x, 32): a shadow's edge that is out of place by so much.
float band(float u, float v, float x, float width)
{
    const float d = (u - x) * 0.9578f + (v - 32.0f) * 0.2873f;
    return std::abs(d) < 0.5f * width ? 0.0f : 1.0f;
}

} // namespace

TEST(Temporal, a_constant_error_does_not_change)
{
    for (const bool fixed : {true, false}) {
        Wall wall{fixed ? still(6) : moving(6, 1.3f, 0.7f), [](size_t, float, float) { return 0.6f; }};
        wall.fixed = fixed;
        const metrics::Temporal m = wall.measure();
        EXPECT_NEAR(m.flicker, 0, 1e-6);
        EXPECT_NEAR(m.swimming, 0, 1e-6);
        EXPECT_NEAR(m.popping, 0, 1e-6);
        EXPECT_GT(m.followed, 1000u);
        EXPECT_EQ(m.moved, 0u);
        EXPECT_EQ(m.noise, 0.0);
    }
}

TEST(Temporal, an_alternating_error_is_all_flicker)
{
    for (const auto& offsets : {still(7), moving(7, 0.4f, 1.1f)}) {
        const metrics::Temporal m = Wall{offsets, [](size_t t, float, float) { return t % 2 ? 1.0f : 0.7f; }}.measure();
        EXPECT_NEAR(m.flicker, 0.3, 1e-6);
        EXPECT_NEAR(m.swimming, 0, 1e-6);
        EXPECT_NEAR(m.popping, 0, 1e-6);
    }
}

TEST(Temporal, a_single_jump_pops_and_does_not_flicker)
{
    const metrics::Temporal m = Wall{moving(8, 0.6f, 0), [](size_t t, float, float) { return t < 5 ? 1.0f : 0.8f; }}.measure();
    EXPECT_NEAR(m.flicker, 0.0, 1e-12);
    EXPECT_NEAR(m.popping, 0.2, 1e-6);
    ASSERT_EQ(m.change.size(), 7u);
    for (size_t t = 1; t < 8; ++t) EXPECT_NEAR(m.change[t - 1], t == 5 ? 0.2 : 0.0, 1e-6) << t;
    // the two triples that hold the jump, of six, see half of it each (the outer frames see fewer points of the wall)
    EXPECT_NEAR(m.swimming, 0.2 / 6, 1e-4);
}

TEST(Temporal, flicker_and_swimming_add_up_to_the_change)
{
    const metrics::Temporal m
        = Wall{still(9), [](size_t t, float u, float v) { return 0.5f + 0.5f * std::sin(float(t * t) * 1.7f + 0.3f * u * v); }}.measure();
    double mean = 0, inner = 0;
    for (size_t t = 0; t < m.change.size(); ++t) mean += m.change[t], inner += t > 0 && t + 1 < m.change.size() ? m.change[t] : 0;
    // each change is part of two triples, the first and the last of one
    EXPECT_NEAR(m.flicker + m.swimming, 0.5 * (mean + inner) / 7.0, 1e-6);
    EXPECT_GT(m.flicker, 0.01);
    EXPECT_GT(m.swimming, 0.01);
}

/// A thin error that is fixed on the surface is sampled by another pixel grid in each frame. What is left of that is a quarter of the mean
/// error or so of half a pixel's width, and a seventh or less from a pixel's width on; the same error sliding along is far more.
TEST(Temporal, a_fixed_error_stays_and_a_sliding_one_swims)
{
    for (const float width : {0.5f, 1.0f, 3.0f})
        for (const auto& step : {std::array{0.37f, 0.0f}, std::array{1.31f, 0.21f}, std::array{-2.7f, 0.83f}}) {
            SCOPED_TRACE(testing::Message() << width << " pixels wide, " << step[0] << " and " << step[1] << " a frame");
            const auto path = moving(8, step[0], step[1]);
            const metrics::Temporal fixed = Wall{path, [&](size_t, float u, float v) { return band(u, v, 48, width); }}.measure();
            const metrics::Temporal sliding
                = Wall{path, [&](size_t t, float u, float v) { return band(u, v, 44 + float(t), width); }}.measure();
            const double mae = double(width) / double(size.width) / 0.9578;
            EXPECT_LT(fixed.flicker + fixed.swimming, (width < 1 ? 0.35 : 0.15) * mae);
            EXPECT_LT(fixed.popping, 0.05 * mae);
            EXPECT_GT(sliding.swimming, 3 * fixed.swimming);
            EXPECT_GT(sliding.swimming, 5 * sliding.flicker);
        }
}

TEST(Temporal, surfaces_that_move_are_left_out_and_counted)
{
    // the left half comes nearer, and only there does the error change
    Wall wall{still(5), [](size_t t, float u, float) { return u < 40 && t % 2 ? 0.0f : 1.0f; }};
    wall.fixed = true;
    wall.depth = [](size_t t, float u, float) { return u < 48 ? 5.0f * float(t) : 0.0f; };
    const metrics::Temporal m = wall.measure();
    EXPECT_EQ(m.flicker, 0.0);
    EXPECT_EQ(m.moved, 3u * 48 * 64);
    EXPECT_EQ(m.followed, 3u * 48 * 64);
}

TEST(Temporal, what_leaves_the_picture_is_lost)
{
    const metrics::Temporal m = Wall{moving(3, 200, 0), [](size_t, float, float) { return 0.0f; }}.measure();
    EXPECT_EQ(m.followed, 0u);
    EXPECT_GT(m.lost, 0u);
    EXPECT_EQ(m.flicker + m.swimming + m.popping, 0.0);
}

TEST(Temporal, noise_of_the_truth_bounds_what_it_adds)
{
    // white noise of the truth, as an error of the test
    const auto hash = [](size_t t, float u, float v) {
        uint32_t h = uint32_t(t) * 0x9e3779b9u + uint32_t(u) * 0x85ebca6bu + uint32_t(v) * 0xc2b2ae35u;
        h = (h ^ h >> 15) * 0x2c1b3c6du, h = (h ^ h >> 12) * 0x297a2d39u;
        return float((h ^ h >> 15) >> 8) / 16777216.0f;
    };
    Wall wall{still(8), [&](size_t t, float u, float v) { return 0.5f + 0.1f * hash(t, u, v); }};
    wall.variance = 0.01f / 12.0f;
    const metrics::Temporal m = wall.measure();
    EXPECT_NEAR(m.flicker + m.swimming, m.noise, 0.05 * m.noise);
    EXPECT_GT(m.noise, 0.001);
}

TEST(Temporal, refuses_what_is_no_sequence)
{
    EXPECT_THROW((Wall{still(2), [](size_t, float, float) { return 0.0f; }}.measure()), base::Error);
}
