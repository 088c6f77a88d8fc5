// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sample_patterns.h"

#include "scene/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using namespace shadow::parts;

/// Of a disk's taps: how they fill it. Equal area gives a mean squared radius of one half.
void expect_even(const std::vector<vec2>& points, float closest)
{
    vec2 centre(0);
    float square = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const float r2 = glm::dot(points[i], points[i]);
        ASSERT_LE(r2, i > 0 ? glm::dot(points[i - 1], points[i - 1]) : 1.0f) << "outermost first";
        centre += points[i] / float(points.size()), square += r2 / float(points.size());
        for (size_t j = 0; j < i; ++j) ASSERT_GT(glm::length(points[i] - points[j]), closest / std::sqrt(float(points.size())));
    }
    EXPECT_LT(glm::length(centre), 0.15f);
    EXPECT_NEAR(square, 0.5f, 0.001f) << points.size();
}

TEST(SamplePatterns, DisksAreFilledEvenly)
{
    for (const int n : {8, 16, 32, 64}) {
        SCOPED_TRACE(n);
        ASSERT_EQ(int(poisson_disk(n).size()), n);
        expect_even(poisson_disk(n), 1.0f);
    }
    for (const int n : {8, 16, 33, 128}) {
        SCOPED_TRACE(n);
        ASSERT_EQ(int(vogel_disk(n).size()), n);
        expect_even(vogel_disk(n), 1.0f);
    }
}

TEST(SamplePatterns, VoidAndClusterIsAnOrderOfAllPixelsWithoutLowFrequencies)
{
    constexpr int size = 32;
    const std::vector<uint32_t> rank = void_and_cluster(size);
    std::vector<uint32_t> sorted = rank;
    std::sort(sorted.begin(), sorted.end());
    for (uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
    // Means of 4 x 4 blocks: sixteen independent values would spread by 1/sqrt(12 * 16) = 0.072 of the whole range.
    double spread = 0;
    for (int by = 0; by < size; by += 4)
        for (int bx = 0; bx < size; bx += 4) {
            double mean = 0;
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) mean += (double(rank[size_t((by + y) * size + bx + x)]) + 0.5) / (size * size) / 16;
            spread += (mean - 0.5) * (mean - 0.5) / 64;
        }
    EXPECT_LT(std::sqrt(spread), 0.03);
}

TEST(SamplePatterns, ASquareFromADiskIsTheWayBack)
{
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
            const vec2 u = vec2(float(i), float(j)) / 20.0f;
            ASSERT_LT(glm::length(disk_to_square(scene::square_to_disk(u)) - (2.0f * u - 1.0f)), 1e-5f) << u.x << " " << u.y;
        }
    float square = 0; // over the square [-1, 1]^2 the mean of x^2 + y^2 is two thirds
    const std::vector<vec2> disk = vogel_disk(128);
    for (const vec2 p : disk) {
        const vec2 q = disk_to_square(p);
        ASSERT_LE(std::max(std::abs(q.x), std::abs(q.y)), 1.0f);
        square += glm::dot(q, q) / 128.0f;
    }
    EXPECT_NEAR(square, 2.0f / 3.0f, 0.01f);
}

} // namespace
} // namespace gnomon
