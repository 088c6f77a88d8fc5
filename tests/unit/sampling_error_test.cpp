// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sampling_error.h"
#include "shadow/parts/warp_parameter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace gnomon::shadow::parts;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

/// Near 1 and half a field of view of 30 degrees.
Frustum frustum(double ratio) { return {1.0, ratio, 30.0 * degree}; }
double best(const Frustum& f) { return optimal_near(f.near, f.far, f.depth()); }

#define EXPECT_RATIO(actual, expected, tolerance) EXPECT_NEAR((actual) / (expected), 1.0, tolerance)

} // namespace

TEST(SamplingError, overhead_storage_factors)
{
    struct Row {
        double ratio, uniform, warped, t, s, logarithmic;
    };
    for (const Row& r : {Row{10, 77.94, 7.794, 2.465, 3.162, 1.994}, Row{100, 8573.7, 85.74, 8.574, 10, 3.988},
             Row{1000, 8.6516e5, 865.16, 27.36, 31.62, 5.982}, Row{1e4, 8.659e7, 8659, 86.59, 100, 7.976}}) {
        const Frustum f = frustum(r.ratio);
        EXPECT_RATIO(overhead_storage(f, no_warp), r.uniform, 3e-4);
        EXPECT_RATIO(overhead_storage(f, best(f)), r.warped, 3e-4);
        EXPECT_RATIO(overhead_largest(f, best(f)).t, r.t, 3e-4);
        EXPECT_RATIO(overhead_largest(f, best(f)).s, r.s, 3e-4);
        EXPECT_RATIO(overhead_largest(f, f.near).t, r.warped, 3e-4);
        EXPECT_RATIO(overhead_largest(f, f.near).s, 1.0, 1e-12);
        EXPECT_RATIO(logarithmic_storage(f), r.logarithmic, 3e-4);
        // (4.24) at the optimum, and (4.25)
        EXPECT_RATIO(overhead_side_ratio(f, best(f)), (1.0 - 1.0 / r.ratio) / (2.0 * std::tan(f.half_fov)), 1e-9);
        EXPECT_RATIO(overhead_storage(f, no_warp) / overhead_storage(f, best(f)), r.ratio, 1e-9);
    }
}

TEST(SamplingError, largest_errors_are_those_of_the_curve)
{
    for (const double ratio : {2.0, 10.0, 1000.0}) {
        const Frustum f = frustum(ratio);
        for (const double n : {1.0, 0.5 * (1.0 + best(f)), best(f), 2.0 * best(f), 50.0 * ratio, no_warp}) {
            Error largest{0, 0};
            for (int i = 0; i <= 4000; ++i) {
                const Error e = overhead_error(f, n, std::pow(ratio, i / 4000.0));
                largest = {std::max(largest.t, e.t), std::max(largest.s, e.s)};
            }
            EXPECT_RATIO(largest.t, overhead_largest(f, n).t, 1e-9) << ratio << " " << n;
            EXPECT_RATIO(largest.s, overhead_largest(f, n).s, 1e-9) << ratio << " " << n;
        }
    }
}

TEST(SamplingError, storage_is_level_up_to_the_optimum_and_rises_to_uniform)
{
    const Frustum f = frustum(100);
    for (const double n : {1.0, 3.0, 8.0, best(f)}) EXPECT_RATIO(overhead_storage(f, n), 85.74, 3e-4);
    double before = overhead_storage(f, best(f));
    for (double n = 12; n < 1e7; n *= 1.5) {
        EXPECT_GT(overhead_storage(f, n), before);
        before = overhead_storage(f, n);
    }
    EXPECT_RATIO(before, overhead_storage(f, no_warp), 1e-3);
    const double trapezoid = trapezoid_near(0.1 * f.depth(), f.depth(), 0.8); // less than the optimum: the same storage, another shape
    EXPECT_LT(trapezoid, best(f));
    EXPECT_RATIO(overhead_storage(f, trapezoid), 85.74, 3e-4);
}

TEST(SamplingError, partitions)
{
    constexpr std::array counts = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 16.0};
    struct Row {
        double ratio;
        std::array<double, 8> uniform, warped, behind;
    };
    const Row rows[] = {{10, {77.94, 11.84, 6.462, 4.794, 4.014, 3.568, 3.081, 2.477},
                            {7.794, 3.745, 2.999, 2.696, 2.533, 2.431, 2.311, 2.145}, {100, 20, 13.93, 12.65, 12.56, 12.93, 14.23, 21.34}},
        {100, {8574, 155.9, 43.92, 23.69, 16.44, 12.92, 9.589, 6.163}, {85.74, 15.59, 9.461, 7.490, 6.547, 5.999, 5.392, 4.621},
            {1e4, 200, 64.6, 40, 31.5, 27.9, 25.3, 28.5}},
        {1000, {8.65e5, 1677, 233.8, 90.06, 51.39, 35.53, 22.53, 11.52}, {865.2, 53.04, 23.38, 16.02, 12.91, 11.24, 9.501, 7.481},
            {1e6, 2000, 300, 126.5, 79.2, 60, 45.0, 37.9}},
        {1e4, {8.66e7, 17147, 1150, 311.8, 145.1, 87.8, 47.4, 19.2}, {8659, 171.5, 53.4, 31.18, 22.99, 18.92, 14.98, 10.78},
            {1e8, 2e4, 1393, 400, 199, 129, 80, 50.6}}};
    for (const Row& row : rows) {
        const Frustum f = frustum(row.ratio);
        for (size_t i = 0; i < counts.size(); ++i) {
            EXPECT_RATIO(partitioned_storage_uniform(f, counts[i]), row.uniform[i], 3e-3) << row.ratio << " " << counts[i];
            EXPECT_RATIO(partitioned_storage_warped(f, counts[i]), row.warped[i], 3e-3) << row.ratio << " " << counts[i];
            EXPECT_RATIO(partitioned_storage_behind(f, counts[i]), row.behind[i], 3e-3) << row.ratio << " " << counts[i];
        }
        EXPECT_RATIO(partitioned_storage_warped(f, 1e5), logarithmic_storage(f), 1e-3);
        EXPECT_RATIO(partitioned_storage_uniform(f, 1e5), logarithmic_storage(f), 1e-3);
        EXPECT_RATIO(face_storage_behind(f, 1e6), 2.0 * std::log(row.ratio) + 1.0, 1e-4);
    }
    // more parts cost texels from 2 ln r on where the light shines along the view
    const Frustum f = frustum(1000);
    EXPECT_RATIO(partitioned_storage_behind(f, 2.0 * std::log(1000.0)), 2.0 * std::exp(1.0) * std::log(1000.0), 1e-9);
    EXPECT_GT(face_storage_behind(f, 3), partitioned_storage_behind(f, 13));
    EXPECT_LT(face_storage_behind(f, 5), partitioned_storage_behind(f, 21));
}

TEST(SamplingError, warped_parts_at_logarithmic_splits_meet_in_t)
{
    const Frustum f = frustum(1000);
    std::vector<double> ends;
    for (int i = 1; i <= 4; ++i) ends.push_back(std::pow(1000.0, i / 4.0));
    for (int i = 0; i < 3; ++i) {
        const double at = ends[size_t(i)];
        const auto jump = [&](Warp warp) {
            const Error a = partitioned_error(f, ends, warp, at), b = partitioned_error(f, ends, warp, at * (1.0 + 1e-12));
            return Error{b.t / a.t, b.s / a.s};
        };
        EXPECT_NEAR(jump(Warp::optimal).t, 1.0, 1e-6);
        EXPECT_GT(jump(Warp::optimal).s, 1.5);
        EXPECT_NEAR(jump(Warp::view).s, 1.0, 1e-6);
        EXPECT_GT(jump(Warp::none).t, 5.0);
    }
    EXPECT_RATIO(partitioned_error(f, ends, Warp::none, 1.0).s, std::pow(1000.0, 0.25), 1e-9);
    EXPECT_RATIO(partitioned_error(f, ends, Warp::view, 1000.0).s, 1.0, 1e-9);
}

TEST(SamplingError, logarithm_is_constant_and_plane_optimal_grows)
{
    const Frustum f = frustum(100);
    EXPECT_DOUBLE_EQ(logarithmic_t(f, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(logarithmic_t(f, 100.0), 1.0);
    for (const double z : {1.0, 7.0, 60.0}) {
        const double dt = (logarithmic_t(f, z * 1.0001) - logarithmic_t(f, z / 1.0001)) / (z * 1.0001 - z / 1.0001);
        EXPECT_RATIO(1.0 / dt, logarithmic_spacing(f, z), 1e-6);
        EXPECT_RATIO(logarithmic_spacing(f, z) / (2.0 * std::tan(f.half_fov) * z), logarithmic_error(f).t, 1e-12);
        // perspective shadow maps are the plane's best
        EXPECT_RATIO(plane_optimal_spacing(f, z) / (2.0 * std::tan(f.half_fov) * z), overhead_error(f, f.near, z).t, 1e-9);
    }
}

// A parallel light that tilts towards the view, near 1, far 100.
TEST(SamplingError, tilted_lights)
{
    struct Row {
        double gamma, uniform, sine, shaped, best;
    };
    const Frustum f = frustum(100);
    for (const Row& r : {Row{5, 11500, 27620, 11500, 11500}, {10, 11370, 28730, 11370, 11370}, {15, 11150, 22610, 10920, 10880},
             {20, 10850, 14020, 9530, 9204}, {25, 10470, 6402, 6999, 5950}, {30, 10000, 1674, 3331, 1212}, {40, 10830, 652, 1004, 452},
             {60, 11490, 238.5, 238.5, 220.8}, {75, 11070, 150.2, 150.2, 150.0}, {90, 9900, 99, 99, 99}}) {
        const double gamma = r.gamma * degree;
        const auto factor = [&](double n) { return storage(tilted_largest(f, gamma, n)); };
        EXPECT_RATIO(factor(no_warp), r.uniform, 2e-3) << r.gamma;
        EXPECT_RATIO(factor(tilted_optimal_near(f, gamma)), r.sine, 4e-3) << r.gamma;
        EXPECT_RATIO(factor(tilted_shaped_near(f, gamma)), r.shaped, 4e-3) << r.gamma;
        EXPECT_RATIO(factor(tilted_best_near(f, gamma)), r.best, 4e-3) << r.gamma;
    }
    for (const auto& [gamma, n] :
        {std::pair{15.0, 351.0}, {20.0, 99.5}, {25.0, 32.2}, {30.0, 10.0}, {40.0, 11.0}, {60.0, 12.1}, {75.0, 12.0}})
        EXPECT_RATIO(tilted_best_near(f, gamma * degree), n, 1e-2) << gamma;
}

// What Lloyd's curve is for: (4.17) alone is up to 2.5 times worse than no warp.
TEST(SamplingError, shaped_warps_are_hardly_worse_than_none)
{
    for (const double half_fov : {15.0, 30.0, 45.0})
        for (const double far : {10.0, 100.0, 1000.0})
            for (double gamma = 1; gamma <= 179; gamma += 2) {
                const Frustum f{1.0, far, half_fov * degree, 1.6};
                const double none = storage(tilted_largest(f, gamma * degree, no_warp));
                const double shaped = storage(tilted_largest(f, gamma * degree, tilted_shaped_near(f, gamma * degree)));
                EXPECT_LE(shaped, (half_fov == 30.0 && far == 100.0 ? 1.003 : 1.02) * none) << gamma << " " << far << " " << half_fov;
            }
    const Frustum f = frustum(100);
    EXPECT_GT(storage(tilted_largest(f, 10.0 * degree, tilted_optimal_near(f, 10.0 * degree))),
        2.5 * storage(tilted_largest(f, 10.0 * degree, no_warp)));
}
