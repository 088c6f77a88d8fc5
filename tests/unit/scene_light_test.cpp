// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gnomon::scene {
namespace {

constexpr int grid = 64;

double mean_over_square(const std::function<double(vec2)>& f)
{
    double sum = 0.0;
    for (int y = 0; y < grid; ++y)
        for (int x = 0; x < grid; ++x) sum += f((vec2(float(x), float(y)) + 0.5f) / float(grid));
    return sum / (grid * grid);
}

Light light_of(LightShape shape)
{
    Light light;
    light.shape = shape;
    return light;
}

TEST(SceneLight, SquareToDiskKeepsArea)
{
    // Moments of the uniform unit disk: E[x] = 0, E[x^2] = 1/4, E[r^2] = 1/2, E[x^4] = 1/8, E[x^2 y^2] = 1/24.
    EXPECT_NEAR(mean_over_square([](vec2 u) { return square_to_disk(u).x; }), 0.0, 1e-5);
    EXPECT_NEAR(mean_over_square([](vec2 u) { return std::pow(square_to_disk(u).x, 2); }), 0.25, 1e-3);
    EXPECT_NEAR(mean_over_square([](vec2 u) { return std::pow(square_to_disk(u).y, 4); }), 0.125, 1e-3);
    EXPECT_NEAR(mean_over_square([](vec2 u) { return std::pow(square_to_disk(u).x * square_to_disk(u).y, 2); }), 1.0 / 24.0, 1e-3);
    EXPECT_NEAR(mean_over_square([](vec2 u) { return glm::dot(square_to_disk(u), square_to_disk(u)); }), 0.5, 1e-3);
    EXPECT_LE(glm::length(square_to_disk(vec2(0.0f))), 1.0f + 1e-6f);
    EXPECT_EQ(square_to_disk(vec2(0.5f)), vec2(0.0f));
}

TEST(SceneLight, BasisIsOrthonormalAndRightHandedEverywhere)
{
    for (vec3 n : {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0), vec3(0, -1, 0), glm::normalize(vec3(1e-4f, -2e-4f, -1)),
             glm::normalize(vec3(0.3f, -0.8f, 0.5f))}) {
        const mat3 m = basis_about(n);
        const mat3 product = glm::transpose(m) * m;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0f : 0.0f, 1e-5f);
        EXPECT_NEAR(glm::determinant(m), 1.0f, 1e-5f);
        EXPECT_EQ(m[2], n);
    }
}

TEST(SceneLight, DirectionalPointsFillTheCapEvenly)
{
    for (float radius : {0.00465f, 0.3f, 1.2f}) {
        const DirectionalLight shape{glm::normalize(vec3(0.3f, -1, 0.2f)), radius};
        const Light light = light_of(shape);
        // For equal solid angle 1 - cos is uniform, so its mean is half its largest value.
        const double largest = 2.0 * std::pow(std::sin(0.5 * radius), 2);
        const double mean = mean_over_square([&](vec2 u) {
            const vec4 p = light_point(light, vec3(1, 2, 3), u);
            EXPECT_EQ(p.w, 0.0f);
            EXPECT_NEAR(glm::length(vec3(p)), 1.0f, 1e-5f);
            // |d - axis|^2 = 2 (1 - cos): without the cancellation of a dot product near 1.
            return 0.5 * std::pow(double(glm::length(vec3(p) + shape.direction)), 2);
        });
        EXPECT_NEAR(mean / largest, 0.5, 2e-3) << radius;
    }
    EXPECT_EQ(vec3(light_point(light_of(DirectionalLight{vec3(0, -1, 0), 0.0f}), vec3(0), vec2(0.3f, 0.9f))), vec3(0, 1, 0));
}

TEST(SceneLight, RectAndDiskPointsLieOnTheLight)
{
    const RectLight rect{{1, 3, 2}, {0.5f, 0, 0}, {0, 0, 2}};
    EXPECT_EQ(light_point(light_of(rect), vec3(0), vec2(0.0f)), vec4(0.5f, 3, 0, 1));
    EXPECT_NEAR(mean_over_square([&](vec2 u) { return std::pow(light_point(light_of(rect), vec3(0), u).z - 2.0f, 2); }), 4.0 / 3.0, 1e-3);
    const DiskLight disk{{0, 2, 0}, glm::normalize(vec3(1, -1, 0)), 0.7f};
    const double mean = mean_over_square([&](vec2 u) {
        const vec3 d = vec3(light_point(light_of(disk), vec3(5), u)) - disk.centre;
        EXPECT_NEAR(glm::dot(d, disk.normal), 0.0f, 1e-6f);
        return double(glm::dot(d, d));
    });
    EXPECT_NEAR(mean, 0.5 * 0.49, 1e-3);
}

TEST(SceneLight, SphereLightsShowADiskThatFacesTheReceiver)
{
    const vec3 receiver(4, -1, 2), centre(1, 3, 0);
    for (LightShape shape : {LightShape(PointLight{centre, 0.5f}), LightShape(SpotLight{centre, vec3(0, -1, 0), 0, 1, 0.5f})}) {
        const Light light = light_of(shape);
        const double mean = mean_over_square([&](vec2 u) {
            const vec4 p = light_point(light, receiver, u);
            EXPECT_EQ(p.w, 1.0f);
            EXPECT_NEAR(glm::dot(vec3(p) - centre, receiver - centre), 0.0f, 1e-5f);
            return double(glm::dot(vec3(p) - centre, vec3(p) - centre));
        });
        EXPECT_NEAR(mean, 0.125, 1e-3);
    }
    EXPECT_EQ(light_point(light_of(PointLight{centre, 0.0f}), receiver, vec2(0.1f)), vec4(centre, 1));
    EXPECT_EQ(light_point(light_of(PointLight{centre, 0.5f}), centre, vec2(0.1f)), vec4(centre, 1));
}

TEST(SceneLight, ReachesOnlyTheConeAndTheEmittingSide)
{
    const Light spot = light_of(SpotLight{{0, 4, 0}, {0, -1, 0}, 0, glm::radians(45.0f), 0});
    EXPECT_TRUE(reaches(spot, vec3(3.9f, 0, 0)));
    EXPECT_FALSE(reaches(spot, vec3(4.1f, 0, 0)));
    EXPECT_FALSE(reaches(spot, vec3(0, 5, 0)));
    // cross(x, z) points down.
    const Light rect = light_of(RectLight{{0, 4, 0}, {1, 0, 0}, {0, 0, 1}});
    EXPECT_TRUE(reaches(rect, vec3(9, 0, 9)));
    EXPECT_FALSE(reaches(rect, vec3(0, 4.5f, 0)));
    const Light disk = light_of(DiskLight{{0, 4, 0}, {1, 0, 0}, 1});
    EXPECT_TRUE(reaches(disk, vec3(1, -3, 0)));
    EXPECT_FALSE(reaches(disk, vec3(-1, 4, 0)));
    EXPECT_TRUE(reaches(light_of(PointLight{}), vec3(0, 99, 0)));
    EXPECT_TRUE(reaches(light_of(DirectionalLight{}), vec3(0, 99, 0)));
}

TEST(SceneLight, SoftMeansAnArea)
{
    EXPECT_FALSE(light_of(DirectionalLight{}).soft());
    EXPECT_TRUE(light_of(DirectionalLight{{0, -1, 0}, 0.01f}).soft());
    EXPECT_FALSE(light_of(PointLight{}).soft());
    EXPECT_TRUE(light_of(PointLight{{0, 1, 0}, 0.1f}).soft());
    EXPECT_FALSE(light_of(SpotLight{}).soft());
    EXPECT_TRUE(light_of(RectLight{}).soft());
    EXPECT_TRUE(light_of(DiskLight{}).soft());
    EXPECT_EQ(kind_name(light_of(DiskLight{}).kind()), "disk");
}

} // namespace
} // namespace gnomon::scene
