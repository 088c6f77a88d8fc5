// SPDX-License-Identifier: Apache-2.0
// Variance soft shadow mapping's decisions over one kernel: identities of two planes, bounds, and the ways of dividing it.
#include "device_fixture.h"
#include "glsl_function.h"
#include "techniques/vssm/vssm.shared.h"
#include "vssm_kernel.shared.h"

#include <cmath>
#include <random>

namespace gnomon {
namespace {

using shaders::KernelCase, shaders::KernelResult;
constexpr int side = VSSM_FIELD;

class VssmKernel : public gpu::DeviceTest {
protected:
    std::vector<float> depths;

    /// A field by its depth at every texel; returns its number.
    template <class F> int add_field(F depth)
    {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) depths.push_back(float(depth(x, y)));
        return int(depths.size()) / (side * side) - 1;
    }
    double depth(int field, int x, int y) const
    {
        return double(depths[size_t((field * side + std::clamp(y, 0, side - 1)) * side + std::clamp(x, 0, side - 1))]);
    }
    std::vector<KernelResult> run(const std::vector<KernelCase>& cases)
    {
        gpu::Buffer extra = device().buffer({depths.size() * sizeof(float), 0, gpu::Memory::device, "depths"});
        device().upload(extra, std::as_bytes(std::span(depths)));
        return gpu::run_glsl_cases<KernelResult>(device(), "tests/gpu/vssm_kernel.comp", cases, &extra);
    }
    /// Lit share of the texels, and the mean x of the others.
    glm::dvec2 brute_force(const KernelCase& c) const
    {
        double lit = 0, area = 0, blockers = 0;
        for (int y = int(std::floor(c.lo.y)); float(y) < c.hi.y; ++y)
            for (int x = int(std::floor(c.lo.x)); float(x) < c.hi.x; ++x) {
                const double covered = (std::min(x + 1.0, double(c.hi.x)) - std::max(double(x), double(c.lo.x)))
                    * (std::min(y + 1.0, double(c.hi.y)) - std::max(double(y), double(c.lo.y)));
                const double at = depth(c.field, x, y) - double(c.t);
                area += covered;
                if (at >= 0)
                    lit += covered;
                else
                    blockers += covered * at;
            }
        return {lit / area, lit < area ? blockers / (area - lit) : 0};
    }
    /// Random fields of steps: a receiver, and blocks before and behind it.
    int add_blocks(std::mt19937& random, bool behind)
    {
        std::uniform_real_distribution<float> unit(0, 1);
        std::vector<float> field(size_t(side * side), 0.5f);
        for (int i = 0; i < 4; ++i) {
            const int x0 = int(unit(random) * 24), y0 = int(unit(random) * 24), w = 4 + int(unit(random) * 16);
            const float z = behind && i % 2 ? 0.6f + 0.4f * unit(random) : -1 + 1.4f * unit(random);
            for (int y = y0; y < std::min(y0 + w, side); ++y)
                for (int x = x0; x < std::min(x0 + w, side); ++x) field[size_t(y * side + x)] = z;
        }
        return add_field([&](int x, int y) { return field[size_t(y * side + x)]; });
    }
};

constexpr int ways[] = {SUBDIVIDE_NONE, SUBDIVIDE_UNIFORM, SUBDIVIDE_ADAPTIVE};

TEST_F(VssmKernel, TwoPlanesGiveTheLitShareAndTheBlockersDepth)
{
    std::vector<KernelCase> cases;
    std::vector<double> lit, x;
    for (const float share : {0.125f, 0.25f, 0.5f, 0.9375f})
        for (const float near : {-0.875f, -0.25f, 0.3125f}) {
            const int field = add_field([&](int col, int) { return float(col) < share * side ? 0.375f : near; });
            for (const int way : ways)
                for (const int per_cell : {0, 1}) {
                    cases.push_back({field, {0, 0}, {side, side}, 0.375f - 1e-6f, vec2(0), way, 3, per_cell, 1e-3f});
                    lit.push_back(double(share));
                    x.push_back(double(near - 0.375f));
                }
        }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        EXPECT_NEAR(double(results[i].area), 1, 1e-5) << i;
        // rounding of moments up to 1, over the variance; the sums themselves are exact
        const double rounding = 1e-5 + 2e-6 / (x[i] * x[i]);
        EXPECT_NEAR(double(cases[i].per_cell ? results[i].per_cell : results[i].pooled), lit[i], rounding) << i;
        EXPECT_NEAR(double(results[i].blocker.x), 1 - lit[i], rounding) << i;
        EXPECT_NEAR(double(results[i].blocker.y / float(x[i])), 1, rounding / (1 - lit[i])) << i;
    }
}

TEST_F(VssmKernel, ABlockerBeforeADeepBackgroundNeedsDivision)
{
    // 37.5 % at -0.2, the rest far behind the receiver at 0: the mean lies behind it, and the undivided kernel counts as lit
    const int field = add_field([](int x, int) { return x < 12 ? -0.2f : 0.8f; });
    std::vector<KernelCase> cases;
    for (const int way : ways)
        for (const int per_cell : {0, 1}) cases.push_back({field, {0, 0}, {side, side}, 0, vec2(0), way, 3, per_cell});
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const bool none = cases[i].subdivision == SUBDIVIDE_NONE;
        EXPECT_NEAR(double(results[i].per_cell), none ? 1.0 : 0.625, 1e-4) << i;
        EXPECT_NEAR(double(results[i].pooled), none ? 1.0 : 0.625, 1e-4) << i;
        if (!none) {
            EXPECT_NEAR(double(results[i].blocker.y), -0.2, 1e-4) << i;
        }
    }
}

TEST_F(VssmKernel, AnUndividedTiltedPlaneIsLit)
{
    const vec2 slope{0.004f, -0.01f};
    const int field = add_field([&](int x, int y) { return 0.1f + slope.x * (float(x) + 0.5f) + slope.y * (float(y) + 0.5f); });
    std::vector<KernelCase> cases;
    for (const int way : ways) // moved to the light by less than the plane falls over a texel
        cases.push_back({field, {3.3f, 2.1f}, {29.3f, 28.1f}, 0.1f - 0.005f, slope, way, 3, 1, 0.001f});
    for (const KernelResult& r : run(cases)) {
        EXPECT_EQ(r.per_cell, 1.0f);
        EXPECT_EQ(r.compared, 0.0f); // the first look decides
    }
}

TEST_F(VssmKernel, EachPartsOwnBoundIsTighterAndStillABound)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<KernelCase> cases;
    for (int f = 0; f < 60; ++f) {
        const int field = add_blocks(random, false); // nothing lies behind the receiver: no part is compared
        for (int i = 0; i < 20; ++i) {
            const vec2 lo = 20.0f * vec2(unit(random), unit(random));
            const float width = 2 + 9 * unit(random);
            cases.push_back({field, lo, lo + width, 0.5f - 1e-6f, vec2(0), i % 2 ? SUBDIVIDE_UNIFORM : SUBDIVIDE_ADAPTIVE, 3, 1, 1e-3f});
        }
    }
    const auto results = run(cases);
    double gain = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        ASSERT_EQ(results[i].compared, 0.0f);
        ASSERT_LE(results[i].per_cell, results[i].pooled + 1e-5f) << i;
        ASSERT_GE(double(results[i].per_cell), brute_force(cases[i]).x - 1e-3) << i;
        gain += double(results[i].pooled - results[i].per_cell) / double(cases.size());
    }
    EXPECT_GT(gain, 0.01);
}

TEST_F(VssmKernel, TheGridsRimCountsByItsCoveredPart)
{
    // two depths in any window: the moments of whatever parts it is cut into say all, so that only the parts' areas can be wrong
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    const int field = add_field([](int x, int y) { return (x / 3 + y / 5) % 2 ? 0.5f : -0.25f; });
    std::vector<KernelCase> cases;
    for (int i = 0; i < 400; ++i) {
        const vec2 lo = 12.0f * vec2(unit(random), unit(random));
        const float widest = i % 4 ? 19.0f : 3.0f;
        const vec2 size = 0.05f + widest * vec2(unit(random), unit(random));
        cases.push_back({field, lo, lo + size, 0.5f - 1e-6f, vec2(0), SUBDIVIDE_UNIFORM});
    }
    const auto results = run(cases);
    size_t mixed = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec2 truth = brute_force(cases[i]);
        EXPECT_NEAR(double(results[i].area), 1, 1e-4) << i;
        EXPECT_NEAR(double(results[i].per_cell), truth.x, 1e-3) << i;
        mixed += truth.x > 0 && truth.x < 1;
    }
    EXPECT_GT(mixed, 300u);
}

TEST_F(VssmKernel, TheTreeEqualsTheGridOfItsLeaves)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<KernelCase> cases;
    for (int f = 0; f < 60; ++f) {
        const int field = add_blocks(random, true);
        for (int i = 0; i < 10; ++i) {
            // the grid cuts at whole texels, the tree anywhere: here at the same ones
            const vec2 lo = glm::floor(8.0f * vec2(unit(random), unit(random)));
            const float width = i % 2 ? 8 : 16;
            const float t = (f % 2 ? 0.4f : 0.53f) + 0.07f * unit(random); // rounding of moments shows beside surfaces
            cases.push_back({field, lo, lo + width, t, vec2(0), SUBDIVIDE_UNIFORM, 3, 1});
            cases.push_back({field, lo, lo + width, t, vec2(0), SUBDIVIDE_ADAPTIVE, 3, 1});
            // pooled bounds accept a node with its mean before the receiver, whatever its parts are: the stated exception
            cases.push_back({field, lo, lo + width, t, vec2(0), SUBDIVIDE_UNIFORM, 3, 0});
            cases.push_back({field, lo, lo + width, t, vec2(0), SUBDIVIDE_ADAPTIVE, 3, 0});
        }
    }
    const auto results = run(cases);
    size_t compared = 0;
    double pooled_difference = 0;
    for (size_t i = 0; i < cases.size(); i += 4) {
        ASSERT_NEAR(double(results[i].area), 1, 1e-5);
        ASSERT_NEAR(double(results[i + 1].area), 1, 1e-5);
        ASSERT_NEAR(results[i].per_cell, results[i + 1].per_cell, 5e-4f) << i;
        ASSERT_NEAR(results[i].blocker.x, results[i + 1].blocker.x, 5e-4f) << i;
        compared += results[i].compared > 0;
        pooled_difference += double(std::abs(results[i + 2].pooled - results[i + 3].pooled)) / double(cases.size() / 4);
    }
    EXPECT_GT(compared, 100u);
    EXPECT_LT(pooled_difference, 0.03);
}

TEST_F(VssmKernel, DividedKernelsComeNearToComparingEveryTexel)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<KernelCase> cases;
    for (int f = 0; f < 100; ++f) {
        const int field = add_blocks(random, true);
        for (int i = 0; i < 10; ++i) {
            const vec2 lo = 10.0f * vec2(unit(random), unit(random));
            for (const int way : ways) cases.push_back({field, lo, lo + 16.0f, 0.49f, vec2(0), way, 3, 1, 0.01f, 0.0005f});
        }
    }
    const auto results = run(cases);
    double off[3] = {}, blocker_off = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec2 truth = brute_force(cases[i]);
        off[i % 3] += std::abs(double(results[i].per_cell) - truth.x) * 3 / double(cases.size());
        if (i % 3 == 2 && truth.x < 0.99) blocker_off += std::abs(double(results[i].blocker.y) - truth.y) * 3 / double(cases.size());
        ASSERT_GE(results[i].blocker.x, 0.0f);
        ASSERT_LE(results[i].blocker.y, 0.0f);
    }
    EXPECT_GT(off[0], 0.1);
    EXPECT_LT(off[1], 0.02);
    EXPECT_LT(off[2], 0.02);
    EXPECT_LT(blocker_off, 0.04);
}

} // namespace
} // namespace gnomon
