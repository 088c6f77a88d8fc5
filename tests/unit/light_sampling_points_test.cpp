// SPDX-License-Identifier: Apache-2.0
// The points that stand for a light, and the layers fitted from them.
#include "techniques/light_sampling/light_points.h"

#include "scene/load.h"
#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using techniques::light_sampling::light_points;
using techniques::light_sampling::Pattern;

constexpr Pattern patterns[] = {Pattern::jittered, Pattern::hammersley};

scene::Light light_of(scene::LightShape shape)
{
    scene::Light light;
    light.shape = shape;
    return light;
}

TEST(LightPoints, OneIsTheCentreAndSoAreAllOfALightWithoutSize)
{
    const scene::LightShape shapes[] = {scene::DirectionalLight{{0, -1, 0}, 0.1f}, scene::SpotLight{.radius = 0.3f},
        scene::PointLight{{1, 2, 3}, 0.5f}, scene::RectLight{}, scene::DiskLight{}};
    for (const Pattern pattern : patterns) {
        for (const scene::LightShape& shape : shapes) {
            const std::vector<vec4> points = light_points(light_of(shape), 1, pattern, vec3(0)).points;
            ASSERT_EQ(points.size(), 1u);
            EXPECT_EQ(points[0], scene::light_point(light_of(shape), vec3(0), vec2(0.5f)));
        }
        EXPECT_EQ(
            light_points(light_of(scene::PointLight{{1, 2, 3}, 0}), 64, pattern, vec3(0)).points, std::vector<vec4>{vec4(1, 2, 3, 1)});
    }
}

TEST(LightPoints, ThereAreAsManyAsAskedForAllOnTheLight)
{
    const scene::RectLight rect{{0, 3, 0}, {0.5f, 0, 0}, {0, 0, 0.25f}};
    const scene::DirectionalLight sun{{0, -1, 0}, 0.1f};
    for (const Pattern pattern : patterns)
        for (const int n : {2, 3, 7, 16, 61, 64, 1000, 1024}) {
            const std::vector<vec4> on_rect = light_points(light_of(rect), n, pattern, vec3(0)).points;
            ASSERT_EQ(on_rect.size(), size_t(n));
            vec3 mean(0);
            for (const vec4 p : on_rect) {
                EXPECT_LE(std::abs(p.x), 0.5f);
                EXPECT_LE(std::abs(p.z), 0.25f);
                EXPECT_FLOAT_EQ(p.y, 3);
                mean += vec3(p) / float(n);
            }
            EXPECT_LT(glm::length(mean - rect.centre), 0.6f / float(n) + 0.4f * std::pow(float(n), -0.75f)) << n;
            const auto spread = light_points(light_of(sun), n, pattern, vec3(0));
            for (const vec4 p : spread.points) {
                EXPECT_EQ(p.w, 0.0f);
                EXPECT_NEAR(glm::length(vec3(p)), 1.0f, 1e-6f);
                EXPECT_GE(p.y, std::cos(0.1f) - 1e-6f);
            }
        }
}

TEST(LightPoints, JitteredCellsOfEqualAreaHoldOnePointEach)
{
    // columns of a row of the square count its points; any count of rows gives strips with their share of the points, give or take one
    for (const int n : {5, 17, 64, 100}) {
        std::vector<float> heights;
        const auto spread = light_points(light_of(scene::RectLight{}), n, Pattern::jittered, vec3(0));
        for (const vec4 p : spread.points) heights.push_back(p.z + 0.5f);
        const int rows = std::max(1, int(std::lround(std::sqrt(double(n)))));
        for (int r = 0; r < rows; ++r) {
            const int begin = n * r / rows, end = n * (r + 1) / rows;
            const auto inside = [&](float z) { return z >= float(begin) / float(n) - 1e-6f && z < float(end) / float(n) + 1e-6f; };
            EXPECT_EQ(std::ranges::count_if(heights, inside), end - begin) << n << ", row " << r;
        }
    }
}

/// Largest difference between the share of points within a distance of the axis, and of the disk's area.
double radial_discrepancy(const std::vector<vec4>& points, vec3 axis)
{
    std::vector<double> squares;
    for (const vec4 p : points) squares.push_back(double(glm::dot(vec3(p), vec3(p))) - std::pow(double(glm::dot(vec3(p), axis)), 2.0));
    std::ranges::sort(squares);
    double worst = 0;
    for (size_t i = 0; i < squares.size(); ++i) worst = std::max(worst, std::abs(squares[i] - (double(i) + 0.5) / double(squares.size())));
    return worst;
}

TEST(LightPoints, ASpheresPointsAreADiskFromEverywhere)
{
    const scene::Light sphere = light_of(scene::PointLight{vec3(0), 1.0f});
    for (const Pattern pattern : patterns) {
        const std::vector<vec4> points = light_points(sphere, 1024, pattern, vec3(3, 5, 1)).points;
        for (const vec4 p : points) ASSERT_LE(glm::length(vec3(p)), 1.0f + 1e-5f);
        for (const vec3 axis : {vec3(3, 5, 1), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, -1, 0.5f), vec3(-3, -5, -1)})
            EXPECT_LT(radial_discrepancy(points, glm::normalize(axis)), 0.04) << axis.x << " " << axis.y << " " << axis.z;
        // points spread evenly over the ball are not: the middle of the disk would be too bright
        std::vector<vec4> even = points;
        for (vec4& p : even) {
            const double r = double(glm::length(vec3(p))), psi = std::asin(std::min(1.0, r));
            const double share = (2 * psi - std::sin(2 * psi)) / double(pi);
            p = vec4(vec3(p) * float(std::cbrt(share) / std::max(r, 1e-9)), 1);
        }
        EXPECT_GT(radial_discrepancy(even, vec3(1, 0, 0)), 0.1);
    }
}

TEST(PointFit, HoldsAllReceiversInTheFewestLayers)
{
    const Bounds bounds{{-4, 0, -4}, {4, 2, 4}};
    const std::vector<vec3> receivers = shadow::parts::corners(bounds);
    const shadow::parts::LightMapSettings settings{.size = 256, .guard_texels = 2.0f};
    const auto layers = [&](vec3 position) { return shadow::parts::fit_point_layers(position, receivers, bounds, settings); };
    EXPECT_EQ(layers({0, 12, 0}).layers.size(), 1u);
    EXPECT_EQ(layers({30, 5, -20}).layers.size(), 1u);
    EXPECT_EQ(layers({0, 1, 0}).layers.size(), 6u); // within
    EXPECT_EQ(layers({0, 2.01f, 0}).layers.size(), 5u); // just above: nothing stands over it
    for (const vec3 position :
        {vec3(0, 12, 0), vec3(30, 5, -20), vec3(0, 1, 0), vec3(0, 2.01f, 0), vec3(5, 1, 5), vec3(4, 2, 4), vec3(0, 4, 1)}) {
        const shadow::parts::PointFit fit = layers(position);
        ASSERT_EQ(fit.layers.size(), fit.faces.size());
        shaders::LightMap cube{};
        cube.layout_kind = LIGHT_MAP_CUBE, cube.centre = position, cube.axes = mat3(1);
        for (int i = 0; i < 1000; ++i) { // a lattice over the box
            const vec3 p = bounds.min + (bounds.max - bounds.min) * vec3(i % 10, i / 10 % 10, i / 100) / 9.0f;
            if (glm::length(p - position) < 0.1f) continue;
            const int face = fit.faces[0] < 0 ? -1 : tests::select_layer(cube, p);
            const auto at = std::ranges::find(fit.faces, face);
            ASSERT_NE(at, fit.faces.end()) << "no layer for " << p.x << " " << p.y << " " << p.z;
            const tests::MapPoint m = tests::project(fit.layers[size_t(at - fit.faces.begin())], p);
            ASSERT_TRUE(m.inside && m.z <= 1.0 && m.z >= 0.0) << p.x << " " << p.y << " " << p.z;
        }
    }
}

TEST(VerticesWithin, AreThoseOfTheCutBox)
{
    const Bounds box{{-1, -2, -3}, {1, 2, 3}};
    Bounds all, half;
    for (const vec3 p : shadow::parts::vertices_within({}, box)) all.add(p);
    EXPECT_LT(glm::length(all.min - box.min) + glm::length(all.max - box.max), 0.01f);
    for (const vec3 p : shadow::parts::vertices_within({vec4(0, 0, 1, 0)}, box)) half.add(p);
    EXPECT_LT(glm::length(half.min - vec3(-1, -2, 0)) + glm::length(half.max - box.max), 0.01f);
    EXPECT_TRUE(shadow::parts::vertices_within({vec4(0, 1, 0, -5)}, box).empty());
    EXPECT_FALSE(shadow::parts::vertices_within({}, {vec3(-1, 0, -1), vec3(1, 0, 1)}).empty()) << "a flat scene";
}

} // namespace
} // namespace gnomon
