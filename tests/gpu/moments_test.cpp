// SPDX-License-Identifier: Apache-2.0
// What four moments say about the blockers of a receiver, and how well integers keep them.
#include "device_fixture.h"
#include "glsl_function.h"
#include "moments.shared.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

using shaders::MomentsCase, shaders::MomentsResult;

struct Layer {
    double mass, z;
};

vec4 moments_of(const std::vector<Layer>& layers)
{
    glm::dvec4 b(0);
    for (const Layer& l : layers) b += l.mass * glm::dvec4(l.z, l.z * l.z, std::pow(l.z, 3), std::pow(l.z, 4));
    return vec4(b);
}

class Moments : public gpu::DeviceTest {
protected:
    static std::vector<MomentsResult> run(const std::vector<MomentsCase>& cases)
    {
        return gpu::run_glsl_cases<MomentsResult>(device(), "tests/gpu/moments.comp", cases);
    }
};

TEST_F(Moments, TwoDepthsBesideTheReceiverAreFoundWithTheirMassesAndMean)
{
    std::vector<MomentsCase> cases;
    std::vector<glm::dvec2> truth;
    for (const double near : {-0.9, -0.4})
        for (const double next : {-0.2, 0.1, 0.7}) // before and behind the receiver at 0.3
            for (const double mass : {0.2, 0.5})
                for (const double rest : {0.1, 0.4}) {
                    cases.push_back({moments_of({{mass, near}, {rest, next}, {1 - mass - rest, 0.3}}), 0.3f});
                    const bool blocks = next < 0.3;
                    truth.push_back({mass + (blocks ? rest : 0), mass * (near - 0.3) + (blocks ? rest * (next - 0.3) : 0)});
                }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) { // 32-bit moments, divided by products of distances of 0.2 and more
        EXPECT_NEAR(double(results[i].before.x), truth[i].x, 2e-3) << i;
        EXPECT_NEAR(double(results[i].before.y), truth[i].y, 2e-3) << i;
    }
}

TEST_F(Moments, TwoBlockersOverTheReceiverDoNotBleed)
{
    // at 0.2 and 0.4 of the range, all dark at 0.41: two moments leave 0.45 of the light
    const std::vector<Layer> layers = {{0.5, -0.6}, {0.5, -0.2}};
    const double t = -0.18, mean = -0.4, variance = 0.04;
    EXPECT_NEAR(variance / (variance + (t - mean) * (t - mean)), 0.45, 0.01);
    const auto results
        = run({{moments_of(layers), float(t), 0.0f}, {moments_of(layers), float(t), 0.5e-6f}, {moments_of(layers), float(t), 60e-6f}});
    EXPECT_GT(results[0].before.x, 0.99f);
    EXPECT_GT(results[1].before.x, 0.99f);
    EXPECT_GT(results[2].before.x, 0.6f); // the bias of 16-bit moments
    for (const size_t i : {0u, 1u}) EXPECT_NEAR(double(results[i].before.y / results[i].before.x), mean - t, 0.01);
}

TEST_F(Moments, ThreeBlockersBleed)
{
    const auto results = run({{moments_of({{1 / 3., -0.8}, {1 / 3., -0.4}, {1 / 3., 0.0}}), 0.05f, 0.5e-6f}});
    EXPECT_LT(results[0].before.x, 0.95f);
    EXPECT_GT(results[0].before.x, 0.3f);
}

TEST_F(Moments, TheMassBeforeTheReceiverIsABound)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<MomentsCase> cases;
    std::vector<double> before;
    for (int i = 0; i < 4000; ++i) {
        std::vector<Layer> layers;
        double total = 0;
        for (int n = 4 + i % 12; n > 0; --n) {
            layers.push_back({0.05 + unit(random), 2 * unit(random) - 1});
            total += layers.back().mass;
        }
        const double t = 2 * unit(random) - 1;
        before.push_back(0);
        for (Layer& l : layers) {
            l.mass /= total;
            if (l.z < t) before.back() += l.mass;
        }
        cases.push_back({moments_of(layers), float(t), 0.5e-6f});
    }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        ASSERT_LE(double(results[i].before.x), before[i] + 1e-3) << i;
        ASSERT_GE(results[i].before.x, -1e-3f) << i;
        ASSERT_LE(results[i].before.y, 1e-3f) << i;
    }
}

TEST_F(Moments, DitheredIntegersKeepTheMeansOfLargeWindows)
{
    // A texel's four values rounded to 18 bits, as windows of 128 x 128 leave them, with a dither of one step.
    std::mt19937 random(23);
    std::uniform_real_distribution<double> unit(0, 1);
    const double step = 1.0 / ((1 << 18) - 1);
    for (const size_t texels : {16u, 256u, 16384u}) {
        std::vector<MomentsCase> depths;
        glm::dvec4 exact(0);
        const double base = unit(random) - 0.5;
        for (size_t i = 0; i < texels; ++i) {
            const float z = float(base + 0.3 * unit(random));
            depths.push_back({vec4(z, z * z, z * z * z, z * z * z * z)});
            exact += glm::dvec4(z, double(z) * z, std::pow(double(z), 3), std::pow(double(z), 4)) / double(texels);
        }
        glm::dvec4 mean(0);
        for (const MomentsResult& r : run(depths))
            for (int k = 0; k < 4; ++k) {
                ASSERT_GE(r.quantised[k], -1e-6f);
                ASSERT_LE(r.quantised[k], 1 + 1e-6f);
                const double dithered = double(r.quantised[k]) + step * (unit(random) - 0.5);
                mean[k] += step * std::round(std::clamp(dithered, 0.0, 1.0) / step) / double(texels);
            }
        const vec4 got = run({{vec4(mean)}})[0].moments;
        // a dithered value is off by less than a step with a deviation of at most 0.58; the basis multiplies by at most 3
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(double(got[k]), exact[k], 4 * 3 * 0.58 * step / std::sqrt(double(texels)) + 3e-7) << texels;
    }
}

} // namespace
} // namespace gnomon
