// SPDX-License-Identifier: Apache-2.0
#include "scene/analytic.h"
#include "truth/truth.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <functional>

using namespace gnomon;
using namespace truth_test;

namespace {

constexpr int samples = 4096;

/// A row of floor points across the penumbra against the closed form: within three standard errors of a stratified mean. Strata that
/// the shadow's edge does not cross have no variance; a curve through an n x n grid crosses at most 2 n of them, each of variance
/// <= 1/4, so the standard error is at most sqrt(2 n / 4) / n^2 (two edges: twice the crossings).
void compare_row(const scene::Scene& s, const scene::Light& light, float x0, float x1, const std::function<double(vec3)>& exact, int edges)
{
    const truth::Tracer tracer(s);
    std::vector<vec3> points, normals;
    for (int i = 0; i <= 60; ++i) {
        points.emplace_back(x0 + (x1 - x0) * float(i) / 60.0f, 0.0f, 0.03f);
        normals.emplace_back(0, 1, 0);
    }
    truth::Settings settings;
    settings.samples = samples;
    const std::vector<double> traced = tracer.visibility_at(points, normals, light, settings);
    const double n = std::sqrt(double(samples)), tolerance = 3.0 * std::sqrt(2.0 * n * edges / 4.0) / (n * n);
    int penumbra = 0;
    double bias = 0.0;
    for (size_t i = 0; i < points.size(); ++i) {
        const double expected = exact(points[i]);
        penumbra += expected > 0.01 && expected < 0.99;
        EXPECT_NEAR(traced[i], expected, tolerance) << "x = " << points[i].x;
        bias += (traced[i] - expected) / double(points.size());
    }
    EXPECT_GE(penumbra, 20) << "the row does not cross the penumbra";
    EXPECT_NEAR(bias, 0.0, tolerance / std::sqrt(double(points.size())) * 1.5);
}

scene::DiskLight disk_light(float radius) { return {vec3(0.2f, 4.0f, 0.1f), vec3(0, -1, 0), radius}; }
// cross(half_u, half_v) = -y
scene::RectLight rect_light() { return {vec3(0.1f, 4.0f, 0.2f), vec3(0.6f, 0, 0), vec3(0, 0, 0.4f)}; }

} // namespace

TEST(TruthAnalytic, half_plane_before_a_rectangle)
{
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-30, 0.3f, -30, 30, 1.5f)});
    const scene::Light light = light_of(rect_light());
    compare_row(
        s, light, -0.5f, 1.5f, [&](vec3 p) { return scene::analytic::half_plane_visibility(light, p, 0.3, 1.5); }, 1);
}

TEST(TruthAnalytic, half_plane_before_a_disk)
{
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-30, 0.3f, -30, 30, 1.5f)});
    const scene::Light light = light_of(disk_light(0.7f));
    compare_row(
        s, light, -0.5f, 1.5f, [&](vec3 p) { return scene::analytic::half_plane_visibility(light, p, 0.3, 1.5); }, 1);
}

TEST(TruthAnalytic, rectangle_before_a_rectangle)
{
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-0.5f, 0.4f, -0.2f, 0.3f, 1.5f)});
    const scene::Light light = light_of(rect_light());
    compare_row(
        s, light, -1.5f, 1.5f,
        [&](vec3 p) {
            return scene::analytic::rect_visibility(std::get<scene::RectLight>(light.shape), p, {-0.5f, -0.2f}, {0.4f, 0.3f}, 1.5);
        },
        2);
}

TEST(TruthAnalytic, disk_before_a_disk)
{
    // 512 sides of the same area: the boundary differs from the circle by less than 1e-5 of its radius.
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_disk(0.5f, 1.5f, 512)});
    const scene::Light light = light_of(disk_light(0.7f));
    compare_row(
        s, light, -1.5f, 1.5f,
        [&](vec3 p) {
            return scene::analytic::disk_visibility(std::get<scene::DiskLight>(light.shape), p, {0, 0}, 0.5, 1.5);
        },
        2);
}

TEST(TruthAnalytic, point_light_throws_the_edge_where_geometry_says)
{
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-30, 0.0f, -30, 30, 1.0f)});
    const truth::Tracer tracer(s);
    for (const scene::LightShape& shape : {scene::LightShape(scene::PointLight{vec3(-1, 3, 0), 0.0f}),
             scene::LightShape(scene::SpotLight{vec3(-1, 3, 0), vec3(0, -1, 0), 1.2f, 1.4f, 0.0f}),
             scene::LightShape(scene::DirectionalLight{glm::normalize(vec3(0.5f, -1, 0)), 0.0f})}) {
        // Similar triangles: the ray through the edge at (0, 1) meets the floor at x = 0.5, for the parallel light as well.
        std::vector<vec3> points, normals;
        for (const float x : {-1.0f, 0.0f, 0.499f, 0.4999f, 0.5001f, 0.501f, 1.0f}) {
            points.emplace_back(x, 0, 0.1f);
            normals.emplace_back(0, 1, 0);
        }
        EXPECT_EQ(tracer.visibility_at(points, normals, light_of(shape), {}), (std::vector<double>{0, 0, 0, 0, 1, 1, 1}));
    }
}

TEST(TruthAnalytic, the_cone_and_the_emitting_side_bound_the_light)
{
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0)});
    const truth::Tracer tracer(s);
    const std::vector<vec3> points{{0, 0, 0}, {5, 0, 0}}, up{{0, 1, 0}, {0, 1, 0}}, down{{0, -1, 0}, {0, -1, 0}};
    const scene::Light spot = light_of(scene::SpotLight{vec3(0, 3, 0), vec3(0, -1, 0), 0.3f, 0.5f, 0.2f});
    EXPECT_EQ(tracer.visibility_at(points, up, spot, {}), (std::vector<double>{1, 0}));
    EXPECT_EQ(tracer.visibility_at(points, down, spot, {}), (std::vector<double>{0, 0})) << "the light is behind the receiver";
    const scene::Light upward = light_of(scene::DiskLight{vec3(0, 3, 0), vec3(0, 1, 0), 0.5f});
    EXPECT_EQ(tracer.visibility_at(points, up, upward, {}), (std::vector<double>{0, 0}));
}

TEST(TruthAnalytic, a_light_cut_by_the_receivers_plane_counts_its_part_in_front)
{
    // The upright rectangle [-1, 1] x [-0.5, 1.5] faces the receiver at the origin, whose plane y = 0 leaves three quarters above.
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, -5)});
    const truth::Tracer tracer(s);
    const scene::Light light = light_of(scene::RectLight{vec3(0, 0.5f, -3), vec3(1, 0, 0), vec3(0, 1, 0)});
    truth::Settings settings;
    settings.samples = samples;
    const double seen = tracer.visibility_at({vec3(0)}, {vec3(0, 1, 0)}, light, settings)[0];
    EXPECT_NEAR(seen, 0.75, 1e-9) << "the cut runs along a border of strata, so no sample is near it";
}
