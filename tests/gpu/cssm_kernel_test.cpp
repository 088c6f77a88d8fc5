// SPDX-License-Identifier: Apache-2.0
// The Fourier series of convolution soft shadow mapping over one kernel: its constants, what is exact, and how far the rest is off.
#include "cssm_kernel.shared.h"
#include "device_fixture.h"
#include "glsl_function.h"
#include "techniques/cssm/cssm_series.h"

#include <cmath>
#include <numbers>
#include <random>

namespace gnomon {
namespace {

using shaders::SeriesCase, shaders::SeriesResult;
using techniques::cssm::make_series, techniques::cssm::Series, techniques::cssm::series_rise;
constexpr int side = CSSM_FIELD;
constexpr int orders[] = {2, 4, 8, 16};

/// Of one depth: the scaled and shifted series, not cut.
double one_texel(int terms, const Series& s, double t, double z)
{
    return 0.5 + double(s.scale) * series_rise(terms, double(s.fill) * 0.5 * (z - t) + double(s.shift));
}

/// By how much ripples rise over 1 and fall below 0.
double overshoot(int terms) { return double(make_series(terms, 0).scale) * series_rise(terms, 0.5 / terms) - 0.5; }

/// Twice the shift, as depth: what is so far before a receiver is dark.
double dark_from(const Series& s) { return 4 * double(s.shift) / double(s.fill); }

class CssmKernel : public gpu::DeviceTest {
protected:
    std::vector<float> depths;

    template <class F> int add_field(F depth)
    {
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) depths.push_back(float(depth(x, y)));
        return int(depths.size()) / (side * side) - 1;
    }
    static SeriesCase kernel(int field, float t, const Series& s, float z = 0, int bits = 0)
    {
        return {field, {0, 0}, {side, side}, t, s.groups, s.scale, s.shift, s.fill, bits, 1e-3f, z};
    }
    std::vector<SeriesResult> run(const std::vector<SeriesCase>& cases)
    {
        gpu::Buffer extra = device().buffer({depths.size() * sizeof(float), 0, gpu::Memory::device, "depths"});
        device().upload(extra, std::as_bytes(std::span(depths)));
        return gpu::run_glsl_cases<SeriesResult>(device(), "tests/gpu/cssm_kernel.comp", cases, &extra);
    }
    /// The mean of f(depth) over a kernel of whole texels.
    template <class F> double mean(const SeriesCase& c, F f) const
    {
        double sum = 0, area = 0;
        for (int y = int(c.lo.y); y < int(c.hi.y); ++y)
            for (int x = int(c.lo.x); x < int(c.hi.x); ++x, area += 1) sum += f(double(depths[size_t((c.field * side + y) * side + x)]));
        return sum / area;
    }
};

TEST_F(CssmKernel, ScalesAndShiftsLeaveRipplesOutside)
{
    const double scales[] = {1.178, 1.121, 1.111, 1.108}, shifts[] = {0.119, 0.064, 0.033, 0.016};
    for (int i = 0; i < 4; ++i) {
        const Series s = make_series(orders[i], 0);
        EXPECT_NEAR(double(s.scale), scales[i], 1e-3);
        EXPECT_NEAR(double(s.shift), shifts[i], 1e-3);
        // all over the depths that are used
        for (double z = -1; z <= 1; z += 1e-3)
            for (double t = -1; t <= 1; t += 0.02) {
                const double v = one_texel(orders[i], s, t, z);
                if (z >= t) {
                    ASSERT_GE(v, 1 - 1e-6) << orders[i] << ": " << z << " behind " << t;
                }
                if (z <= t - dark_from(s)) {
                    ASSERT_LE(v, 1e-6) << orders[i] << ": " << z << " before " << t;
                }
            }
    }
}

TEST_F(CssmKernel, FilteringFirstEqualsTheMeanOfEveryTexelsSeries)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> depth(-1, 1);
    std::vector<SeriesCase> cases;
    std::vector<int> terms;
    for (int f = 0; f < 20; ++f) {
        const int field = add_field([&](int, int) { return depth(random); });
        for (const int m : orders) {
            cases.push_back(kernel(field, depth(random), make_series(m, 0)));
            cases.back().lo = {float(f % 5), float(f % 3)};
            terms.push_back(m);
        }
    }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const SeriesCase& c = cases[i];
        const Series s = make_series(terms[i], 0);
        const auto lit = [&](double z) { return one_texel(terms[i], s, double(c.t), z); };
        const double blocked = 1 - mean(c, lit), x = mean(c, [&](double z) { return (1 - lit(z)) * z; }) / blocked - double(c.t);
        EXPECT_NEAR(double(results[i].lit), 1 - blocked, 1e-5) << i;
        if (blocked > 0.1) {
            EXPECT_NEAR(double(results[i].blocker.y), x, 1e-4) << i;
        }
    }
}

TEST_F(CssmKernel, TwoPlanesGiveTheBlockersDepthAndTheLitShare)
{
    std::vector<SeriesCase> cases;
    std::vector<double> share;
    std::vector<int> terms;
    for (const int m : orders)
        for (const int columns : {1, 4, 8, 15})
            for (const float z : {-0.9f, -0.2f, 0.1f, 0.25f}) {
                const int field = add_field([&](int x, int) { return x < columns ? z : 0.4f; });
                cases.push_back(kernel(field, 0.4f, make_series(m, 1e-6), z));
                share.push_back(1 - columns / double(side));
                terms.push_back(m);
            }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const double gap = double(cases[i].t - cases[i].z), blocked = 1 - share[i];
        const bool distinct = gap > dark_from(make_series(terms[i], 0));
        // a single plane at the receiver counts as 1 to rounding: the quotient has only blockers in it, however near
        EXPECT_NEAR(double(results[i].blocker.y), -gap, 2e-3 / (blocked * (1 - std::min(double(results[i].level), 0.98)))) << i;
        if (results[i].level < 0.98f) {
            EXPECT_NEAR(double(results[i].levelled), share[i], 1e-3 / (1 - double(results[i].level))) << i;
        }
        if (distinct) { // as it stands, ripples below 0 take light from the window's lit part
            EXPECT_LE(double(results[i].lit), share[i] + 1e-3) << i;
            EXPECT_GE(double(results[i].lit), share[i] - blocked * overshoot(terms[i]) - 1e-3) << i;
        } else { // and a blocker near by is not dark
            EXPECT_GT(double(results[i].lit), share[i]) << i;
        }
    }
}

TEST_F(CssmKernel, AVisiblePlaneIsLitHoweverItIsRounded)
{
    std::vector<SeriesCase> cases;
    for (int i = 0; i < 100; ++i) {
        const float z = -1 + float(i) / 50;
        const int field = add_field([&](int, int) { return z; });
        for (const int m : orders)
            for (const int bits : {0, 8, 16}) cases.push_back(kernel(field, z, make_series(m, bits ? 1 / std::exp2(bits) : 0), z, bits));
    }
    for (const SeriesResult& r : run(cases)) {
        EXPECT_GE(r.lit, 1.0f);
        EXPECT_EQ(r.levelled, 1.0f);
        EXPECT_EQ(r.blocker.x, 0.0f);
    }
}

TEST_F(CssmKernel, LightFallsAsTheReceiverSinks)
{
    // exactly so for one plane, once it is cut; by ripples less for several
    const int plane = add_field([](int, int) { return -0.3f; });
    const int steps = add_field([](int x, int y) { return -0.8f + 0.1f * float((x * 5 + y * 3) % 16); });
    for (const int m : orders) {
        std::vector<SeriesCase> cases;
        for (const int field : {plane, steps})
            for (int i = 0; i <= 200; ++i) cases.push_back(kernel(field, -1 + float(i) / 100, make_series(m, 0)));
        const auto results = run(cases);
        for (size_t i = 1; i < cases.size(); ++i) {
            if (i == 201) continue;
            const float rise = glm::clamp(results[i].lit, 0.0f, 1.0f) - glm::clamp(results[i - 1].lit, 0.0f, 1.0f);
            ASSERT_LE(double(rise), i < 201 ? 1e-5 : overshoot(m) / 4) << m << " terms, t = " << cases[i].t;
        }
    }
}

TEST_F(CssmKernel, BlockersDepthComesNearToThatOfComparingEveryTexel)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    double off[4] = {};
    size_t counted = 0;
    std::vector<SeriesCase> cases;
    for (int f = 0; f < 150; ++f) {
        std::vector<float> field(size_t(side * side), 0.5f);
        for (int i = 0; i < 5; ++i) {
            const int x0 = int(unit(random) * 12), y0 = int(unit(random) * 12), w = 3 + int(unit(random) * 6);
            const float z = i % 2 ? 0.5f + 0.5f * unit(random) : -1 + 1.3f * unit(random);
            for (int y = y0; y < std::min(y0 + w, side); ++y)
                for (int x = x0; x < std::min(x0 + w, side); ++x) field[size_t(y * side + x)] = z;
        }
        const int number = add_field([&](int x, int y) { return field[size_t(y * side + x)]; });
        for (const int m : orders) cases.push_back(kernel(number, 0.5f, make_series(m, 0)));
    }
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); i += 4) {
        const double blocked = mean(cases[i], [](double z) { return z < 0.5 ? 1.0 : 0.0; });
        // below, ripples of what lies behind the receiver outweigh the blockers
        if (blocked < 0.15) continue;
        ++counted;
        const double truth = mean(cases[i], [](double z) { return z < 0.5 ? z - 0.5 : 0.0; }) / blocked;
        double nearest = 0;
        mean(cases[i], [&](double z) { return nearest = std::min(nearest, z - 0.5); });
        for (size_t k = 0; k < 4; ++k) off[k] += std::abs(std::clamp(double(results[i + k].blocker.y), nearest, 0.0) - truth);
    }
    ASSERT_GT(counted, 80u);
    for (size_t k = 0; k < 4; ++k) off[k] /= double(counted);
    // of a depth range of 2
    EXPECT_LT(off[1], 0.12);
    EXPECT_LT(off[2], 0.08);
    EXPECT_LT(off[3], 0.06);
    EXPECT_LT(off[3], off[1]);
}

} // namespace
} // namespace gnomon
