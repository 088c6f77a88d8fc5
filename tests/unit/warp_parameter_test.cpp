// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/warp_parameter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace gnomon::shadow::parts;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

/// Error along the map's second axis, up to a constant: (4.11), v' = n + (z - z0) extent / (z1 - z0).
double error_along(double z, double n, double z0, double z1, double extent)
{
    const double f = n + extent, v = n + (z - z0) * extent / (z1 - z0);
    return v * v / z * (f - n) / (f * n);
}

} // namespace

TEST(WarpParameter, optimum_has_equal_errors_at_both_ends_and_the_least_maximum)
{
    for (const auto& line : {std::array{1.0, 100.0, 99.0}, std::array{0.3, 7.0, 20.0}, std::array{2.0, 2.5, 0.1}}) {
        const double z0 = line[0], z1 = line[1], extent = line[2];
        const double n = optimal_near(z0, z1, extent);
        EXPECT_NEAR(error_along(z0, n, z0, z1, extent) / error_along(z1, n, z0, z1, extent), 1.0, 1e-12);
        const auto largest = [&](double at) {
            double most = 0.0;
            for (int i = 0; i <= 1000; ++i) most = std::max(most, error_along(z0 + (z1 - z0) * i / 1000.0, at, z0, z1, extent));
            return most;
        };
        for (const double factor : {0.5, 0.9, 1.1, 2.0}) EXPECT_LT(largest(n), largest(n * factor));
    }
    EXPECT_DOUBLE_EQ(optimal_near(1.0, 100.0, 99.0), 11.0); // overhead: zn + sqrt(zn zf), (4.18)
    EXPECT_TRUE(std::isinf(optimal_near(3.0, 3.0, 5.0)));
}

TEST(WarpParameter, falloff_is_continuous_and_grows_with_tilt)
{
    for (const double half_fov : {10.0 * degree, 30.0 * degree, 60.0 * degree}) {
        EXPECT_EQ(falloff(0.0, half_fov), -1.0);
        EXPECT_EQ(falloff(half_fov / 3.0, half_fov), -1.0);
        EXPECT_NEAR(falloff(half_fov, half_fov), -0.2, 1e-12);
        EXPECT_EQ(falloff(90.0 * degree, half_fov), 0.0);
        double before = -1.0;
        for (double gamma = 0.0; gamma <= 90.0 * degree; gamma += 0.01 * degree) {
            const double now = falloff(gamma, half_fov);
            EXPECT_GE(now, before);
            EXPECT_LT(now - before, 0.02);
            before = now;
        }
        EXPECT_NEAR(falloff(70.0 * degree, half_fov), falloff(110.0 * degree, half_fov), 1e-12);
    }
}

TEST(WarpParameter, eta_spans_no_warp_to_the_views_own_perspective)
{
    EXPECT_TRUE(std::isinf(near_from_eta(-1.0, 1.0, 100.0, 99.0)));
    EXPECT_DOUBLE_EQ(near_from_eta(0.0, 1.0, 100.0, 99.0), 11.0);
    EXPECT_NEAR(near_from_eta(1.0, 1.0, 100.0, 99.0), 1.0, 1e-12);
    EXPECT_NEAR(near_from_eta(-1e-12, 1.0, 100.0, 99.0), near_from_eta(1e-12, 1.0, 100.0, 99.0), 1e-9);
    double before = near_from_eta(-0.999, 1.0, 100.0, 50.0);
    for (double eta = -0.99; eta <= 1.0; eta += 0.01) {
        const double n = near_from_eta(eta, 1.0, 100.0, 50.0);
        EXPECT_LT(n, before);
        before = n;
    }
    EXPECT_TRUE(std::isinf(near_from_eta(0.5, 2.0, 2.0, 1.0)));
}

/// A directional light that makes gamma with the view's axis, near 1, far 100, half a field of view of 30 degrees, aspect 1: the frustum
/// is 2 tan(30) 100 cos(gamma) wide along the map, or less, where the far plane's lower edge lies before the near plane's.
TEST(WarpParameter, tilted_lights)
{
    const double half_fov = 30.0 * degree, tangent = std::tan(half_fov);
    const auto line = [&](double gamma) {
        const double s = std::sin(gamma), c = std::cos(gamma) * tangent;
        const double extent = std::max(100 * (s + c), s + c) - std::min(100 * (s - c), s - c);
        return WarpLine{1.0, 1.0 + extent * s, extent, 1.0, 1.0 + extent * s};
    };
    const std::pair<double, double> expected[]
        = {{15, 571}, {20, 215}, {25, 100}, {30, 45.4}, {40, 20.7}, {60, 12.7}, {75, 11.8}, {90, 11}};
    for (const auto& [gamma, n] : expected) EXPECT_NEAR(warp_near(line(gamma * degree), gamma * degree, half_fov) / n, 1.0, 6e-3) << gamma;
    for (const double gamma : {5.0, 10.0}) EXPECT_TRUE(std::isinf(warp_near(line(gamma * degree), gamma * degree, half_fov)));
    const std::pair<double, double> sine[]
        = {{5, 49.6}, {10, 32.0}, {15, 25.0}, {20, 21.0}, {25, 18.3}, {30, 16.3}, {40, 14.6}, {60, 12.7}};
    for (const auto& [gamma, n] : sine) {
        const WarpLine l = line(gamma * degree);
        EXPECT_NEAR(optimal_near(l.z0, l.z1, l.extent) / n, 1.0, 4e-3) << gamma;
    }
}

TEST(WarpParameter, pseudo_near_plane_has_the_least_storage_factor)
{
    EXPECT_DOUBLE_EQ(pseudo_near(1.0, 100.0, 99.0, 1.0, 100.0), 11.0);
    EXPECT_DOUBLE_EQ(pseudo_near(1.0, 100.0, 99.0, 0.5, 200.0), 11.0); // planes outside of the line say nothing
    EXPECT_NEAR(pseudo_near(1.0, 100.0, 99.0, 2.0, 100.0), 15.14, 5e-3);
    EXPECT_NEAR(pseudo_near(1.0, 100.0, 99.0, 21.0, 100.0), 46.8, 5e-2);
    EXPECT_NEAR(pseudo_near(1.0, 100.0, 198.0, 21.0, 100.0), 2 * 46.83, 5e-2);
    EXPECT_TRUE(std::isinf(pseudo_near(1.0, 100.0, 99.0, 70.0, 100.0)));
    // S over [1 + d, 100] from (4.19): the product of both largest errors
    const auto storage = [](double n, double d) {
        double most = 0.0, across = 0.0;
        for (int i = 0; i <= 2000; ++i) {
            const double z = 1.0 + d + (99.0 - d) * i / 2000.0;
            most = std::max(most, error_along(z, n, 1.0, 100.0, 99.0));
            across = std::max(across, (n + z - 1.0) / z * 100.0 / (n + 99.0));
        }
        return most * across;
    };
    for (const double d : {0.5, 1.0, 5.0, 20.0, 40.0, 55.0, 60.0}) {
        const double n = pseudo_near(1.0, 100.0, 99.0, 1.0 + d, 100.0);
        for (const double factor : {0.8, 0.95, 1.05, 1.25, 2.0})
            EXPECT_LE(storage(n, d), storage(n * factor, d) * 1.0001) << d << " " << factor;
    }
}

TEST(WarpParameter, trapezoid_gives_the_focus_its_share)
{
    for (const double focus : {1.0, 5.0, 30.0}) {
        const double n = trapezoid_near(focus, 50.0, 0.8);
        EXPECT_NEAR((n + 50.0) * focus / ((n + focus) * 50.0), 0.8, 1e-12);
    }
    EXPECT_TRUE(std::isinf(trapezoid_near(40.0, 50.0, 0.8)));
}
