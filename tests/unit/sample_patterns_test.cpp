// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sample_patterns.h"

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

} // namespace
} // namespace gnomon
