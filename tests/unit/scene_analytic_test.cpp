// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/analytic.h"

#include <gtest/gtest.h>

#include <functional>

namespace gnomon::scene {
namespace {

/// Visibility by points on the light: the fraction whose segment to p meets the plane of the blocker outside `covers`.
double counted(const Light& light, vec3 p, double blocker_y, const std::function<bool(double, double)>& covers)
{
    constexpr int n = 200;
    if (!reaches(light, p)) return 0.0;
    int seen = 0;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const vec4 q = light_point(light, p, (vec2(float(i), float(j)) + 0.5f) / float(n));
            const double t = (blocker_y - double(p.y)) / (double(q.y) - double(p.y));
            const bool crosses = t > 0.0 && t < 1.0;
            if (!crosses || !covers(glm::mix(double(p.x), double(q.x), t), glm::mix(double(p.z), double(q.z), t))) ++seen;
        }
    }
    return double(seen) / (n * n);
}

Light light_of(LightShape shape)
{
    Light light;
    light.shape = shape;
    return light;
}

constexpr double tolerance = 5e-3; // 200^2 points leave an edge within one row: 1/200 of the light

TEST(SceneAnalytic, HalfPlaneAgainstCounting)
{
    const Light rect = light_of(RectLight{{0.2f, 4, 0}, {0.75f, 0, 0}, {0, 0, 0.5f}});
    const Light disk = light_of(DiskLight{{0.2f, 4, 0}, {0, -1, 0}, 0.6f});
    int partial = 0;
    for (const Light& light : {rect, disk}) {
        for (float x = -2.0f; x <= 2.0f; x += 0.11f) {
            const vec3 p(x, 0, 0.3f);
            const double exact = analytic::half_plane_visibility(light, p, 0.1, 2.0);
            EXPECT_NEAR(exact, counted(light, p, 2.0, [](double bx, double) { return bx <= 0.1; }), tolerance) << x;
            partial += exact > 0.01 && exact < 0.99;
        }
    }
    EXPECT_GT(partial, 15);
}

TEST(SceneAnalytic, HalfPlaneRampIsLinearForARectangle)
{
    const Light rect = light_of(RectLight{{0, 4, 0}, {0, 0, 0.5f}, {-0.75f, 0, 0}}); // sides swapped: cross still points down
    ASSERT_TRUE(reaches(rect, vec3(0)));
    // The edge at x = 0, y = 2 seen from (x, 0): it falls on the light at -x, so that visibility is (0.75 + x) / 1.5.
    EXPECT_NEAR(analytic::half_plane_visibility(rect, {0.3f, 0, 0}, 0.0, 2.0), 0.7, 1e-6);
    EXPECT_NEAR(analytic::half_plane_visibility(rect, {-0.3f, 0, 9}, 0.0, 2.0), 0.3, 1e-6);
    EXPECT_EQ(analytic::half_plane_visibility(rect, {1, 0, 0}, 0.0, 2.0), 1.0);
    EXPECT_EQ(analytic::half_plane_visibility(rect, {-1, 0, 0}, 0.0, 2.0), 0.0);
}

TEST(SceneAnalytic, RectangleAgainstCounting)
{
    const RectLight shape{{0.3f, 4, -0.2f}, {0.5f, 0, 0}, {0, 0, 0.9f}};
    int partial = 0;
    for (float x = -2.0f; x <= 2.0f; x += 0.31f) {
        for (float z = -1.6f; z <= 1.6f; z += 0.37f) {
            const vec3 p(x, 0.1f, z);
            const double exact = analytic::rect_visibility(shape, p, {-0.8f, -0.5f}, {0.8f, 0.5f}, 1.5);
            const double count
                = counted(light_of(shape), p, 1.5, [](double bx, double bz) { return std::abs(bx) <= 0.8 && std::abs(bz) <= 0.5; });
            EXPECT_NEAR(exact, count, 2 * tolerance) << x << " " << z;
            partial += exact > 0.01 && exact < 0.99;
        }
    }
    EXPECT_GT(partial, 20);
}

TEST(SceneAnalytic, DiskAgainstCounting)
{
    // A blocker that can cover the light, and one so small that it lies within it.
    for (float radius : {0.7f, 0.1f}) {
        const DiskLight shape{{0.3f, 4, -0.2f}, {0, -1, 0}, 0.6f};
        int partial = 0;
        for (float x = -1.6f; x <= 1.6f; x += 0.23f) {
            for (float z = -1.2f; z <= 1.2f; z += 0.37f) {
                const vec3 p(x, 0, z);
                const double exact = analytic::disk_visibility(shape, p, {0.1f, 0}, radius, 1.5);
                const double count = counted(light_of(shape), p, 1.5,
                    [&](double bx, double bz) { return (bx - 0.1) * (bx - 0.1) + bz * bz <= double(radius) * double(radius); });
                EXPECT_NEAR(exact, count, tolerance) << x << " " << z;
                partial += exact > 0.01 && exact < 0.99;
            }
        }
        EXPECT_GT(partial, 5);
    }
}

TEST(SceneAnalytic, OutsideTheCase)
{
    const RectLight down{{0, 4, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}};
    EXPECT_EQ(analytic::rect_visibility(down, {0, 2, 0}, vec2(-1), vec2(1), 1.5), 1.0); // above the blocker
    EXPECT_EQ(analytic::rect_visibility(down, {0, 5, 0}, vec2(-1), vec2(1), 1.5), 0.0); // behind the light
    const RectLight tilted{{0, 4, 0}, {0.5f, 0.1f, 0}, {0, 0, 0.5f}}, turned{{0, 4, 0}, {0.5f, 0, 0.5f}, {-0.5f, 0, 0.5f}};
    EXPECT_THROW(analytic::rect_visibility(tilted, vec3(0), vec2(-1), vec2(1), 1.5), base::Error);
    EXPECT_THROW(analytic::rect_visibility(turned, vec3(0), vec2(-1), vec2(1), 1.5), base::Error);
    EXPECT_THROW(analytic::disk_visibility({{0, 4, 0}, {0.6f, -0.8f, 0}, 1}, vec3(0), vec2(0), 1, 1.5), base::Error);
    EXPECT_THROW(analytic::half_plane_visibility(light_of(PointLight{}), vec3(0), 0, 1), base::Error);
}

} // namespace
} // namespace gnomon::scene
