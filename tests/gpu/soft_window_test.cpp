// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"
#include "tests/light_map_twin.h"
#include "twins.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

using scene::Light;

class SoftWindow : public gpu::DeviceTest {
protected:
    static constexpr Bounds bounds{{-4, 0, -4}, {4, 4, 4}};

    static shaders::LightMap map_of(const Light& light, shadow::parts::Fit fit = shadow::parts::Fit::uniform)
    {
        const scene::View view = scene::make_view({"", {4, 3, 9}, {0, 1, 0}, {0, 1, 0}, 0.4f}, {320, 200}, bounds);
        return shadow::parts::fit_light_map({}, bounds, view, light, {.size = 512, .fitting = {.fit = int(fit)}, .guard_texels = 65});
    }

    static std::vector<shaders::SoftResult> run(const std::vector<shaders::SoftCase>& cases)
    {
        return gpu::run_glsl_cases<shaders::SoftResult>(device(), "tests/gpu/soft_window.comp", cases);
    }

    static vec3 direction()
    {
        std::normal_distribution<float> normal;
        return glm::normalize(vec3(normal(random()), normal(random()), normal(random())));
    }

    static float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random()); }

    static std::mt19937& random()
    {
        static std::mt19937 generator(11);
        return generator;
    }

    static Light light_of(scene::LightShape shape)
    {
        Light light;
        light.shape = shape;
        return light;
    }

    /// A light of each kind with its centre at `c`, shining along `d`, `size` metres (a sun: radians).
    static std::vector<Light> lights(vec3 c, vec3 d, float size)
    {
        const mat3 basis = scene::basis_about(d);
        return {light_of(scene::DirectionalLight{d, size}), light_of(scene::SpotLight{c, d, 0.1f, 1.0f, size}),
            light_of(scene::PointLight{c, size}), light_of(scene::RectLight{c, size * basis[0], 0.6f * size * basis[1]}),
            light_of(scene::DiskLight{c, d, size})};
    }
};

/// The fraction of the light on n's side of the plane through p, by its own definition.
double counted_above(const Light& light, vec3 p, vec3 n)
{
    constexpr int side = 300;
    int above = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const vec4 q = scene::light_point(light, p, (vec2(float(x), float(y)) + 0.5f) / float(side));
            above += glm::dot(n, q.w == 0.0f ? vec3(q) : vec3(q) - p) > 0.0f;
        }
    return double(above) / (side * side);
}

TEST_F(SoftWindow, TheHorizonIsTheCountOfPointsAboveThePlane)
{
    std::vector<Light> of;
    std::vector<shaders::SoftCase> cases;
    const auto add = [&](const Light& light, vec3 p, vec3 n) {
        of.push_back(light);
        cases.push_back({map_of(light).layers[0], shadow::light_constants(light, bounds), p, n, 1.0f});
    };
    for (int i = 0; i < 60; ++i) {
        const vec3 p(uniform(-4, 4), 0, uniform(-4, 4)), towards = direction();
        const float away = uniform(0.3f, 3.0f);
        for (const Light& light : lights(p + away * towards, i % 4 ? direction() : -towards, 0.3f)) {
            // planes that may cut the light: their normals across the direction to it, or nearly
            const vec4 middle = scene::light_point(light, p, vec2(0.5f));
            const vec3 to = glm::normalize(middle.w == 0.0f ? vec3(middle) : vec3(middle) - p);
            const vec3 side = scene::basis_about(to) * vec3(std::cos(float(i)), std::sin(float(i)), 0);
            add(light, p, glm::normalize(side + uniform(-0.5f, 0.5f) * to));
        }
    }
    const auto results = run(cases);
    int between = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const double counted = counted_above(of[i], cases[i].p_world, cases[i].n);
        ASSERT_NEAR(double(results[i].horizon), counted, 0.01) << scene::kind_name(of[i].kind()) << " " << i;
        between += counted > 0.02 && counted < 0.98;
    }
    EXPECT_GT(between, 60);
}

TEST_F(SoftWindow, AHorizonAlongASideOrThroughNothingIsFinite)
{
    std::vector<shaders::SoftCase> cases;
    std::vector<float> expected;
    const auto add = [&](const Light& light, vec3 p, vec3 n, float fraction) {
        const shaders::LightMap map = map_of(light);
        cases.push_back({map.layers[tests::select_layer(map, p)], shadow::light_constants(light, bounds), p, n, 1.0f});
        expected.push_back(fraction);
    };
    const Light rect = light_of(scene::RectLight{{0, 2, 0}, {1, 0, 0}, {0, 0, 0.5f}});
    add(rect, {0.5f, 0, 0}, {1, 0, 0}, 0.25f);
    add(rect, {0, 0, 0.25f}, {0, 0, 1}, 0.25f);
    add(rect, {0, 0, 0}, glm::normalize(vec3(1, 0, 1e-6f)), 0.5f);
    add(rect, {1, 0, 0}, {1, 0, 0}, 0.0f);
    add(rect, {0, 2, 0}, {0, 1, 0}, 0.0f); // in the light's own plane
    add(rect, {0, 1, 0}, {0, 1, 0}, 1.0f);
    add(light_of(scene::PointLight{{0, 2, 0}, 0.0f}), {1, 2, 0}, {0, 1, 0}, 0.0f); // no size, on the horizon
    add(light_of(scene::PointLight{{0, 2, 0}, 0.0f}), {0, 2, 0}, {0, 1, 0}, 0.0f); // at the light itself
    add(light_of(scene::DirectionalLight{{0, -1, 0}, 0.0f}), {0, 0, 0}, {0, 1, 0}, 1.0f);
    add(light_of(scene::DirectionalLight{{0, -1, 0}, 1.5707964f}), {0, 0, 0}, {1, 0, 0}, 0.5f); // half the sky
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        EXPECT_NEAR(results[i].horizon, expected[i], 1e-5f) << i;
        EXPECT_TRUE(std::isfinite(results[i].size.x) && std::isfinite(results[i].size.y)) << i;
    }
}

TEST_F(SoftWindow, TheWindowIsWhatThePyramidCutsOut)
{
    std::vector<shaders::SoftCase> cases;
    std::vector<Light> of;
    std::vector<shaders::LightMap> maps;
    int warped_cases = 0;
    for (int i = 0; i < 40; ++i)
        for (const Light& light : lights({uniform(-1, 1), uniform(3, 5), uniform(-1, 1)}, glm::normalize(vec3(0.3f, -1, 0.2f)), 0.05f)) {
            const shaders::LightMap map = map_of(light);
            const vec3 p(uniform(-4, 4), 0, uniform(-4, 4));
            if (light.kind() == scene::LightKind::spot && !scene::reaches(light, p)) continue;
            const shaders::LightMapLayer& layer = map.layers[tests::select_layer(map, p)];
            const float d = glm::dot(layer.depth_plane, vec4(p, 1));
            cases.push_back({layer, shadow::light_constants(light, bounds), p, vec3(0, 1, 0), d - uniform(0.0f, 0.7f) * (d - layer.near)});
            of.push_back(light), maps.push_back(map);
            for (const auto fit : {shadow::parts::Fit::lispsm, shadow::parts::Fit::psm}) {
                const shaders::LightMap warped = map_of(light, fit);
                if (warped.layers[0].warped == 0 || !tests::project(warped.layers[0], p).inside) continue;
                cases.push_back(cases.back());
                cases.back().layer = warped.layers[0];
                const float depth = glm::dot(warped.layers[0].depth_plane, vec4(p, 1));
                cases.back().z = depth - uniform(0.0f, 0.7f) * (depth - warped.layers[0].near);
                of.push_back(light), maps.push_back(warped), ++warped_cases;
            }
        }
    EXPECT_GT(warped_cases, 20);
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const shaders::SoftCase& c = cases[i];
        const glm::dvec2 at = tests::project(c.layer, c.p_world).uv;
        // the farthest that points on the rays to the light, at depth z, fall from the receiver: texels
        const vec3 axis(c.layer.depth_plane);
        const float d = glm::dot(c.layer.depth_plane, vec4(c.p_world, 1));
        glm::dvec2 farthest(0);
        for (int k = 0; k < 4096; ++k) {
            const vec4 q = scene::light_point(of[i], c.p_world, (vec2(float(k % 64), float(k / 64)) + 0.5f) / 64.0f);
            const vec3 ray = q.w == 0.0f ? vec3(q) : vec3(q) - c.p_world;
            const vec3 on_plane = c.p_world + ray * ((c.z - d) / glm::dot(axis, ray));
            farthest = glm::max(farthest, glm::abs(tests::project(c.layer, on_plane).uv - at));
        }
        farthest *= maps[i].size;
        // of points within the outermost of 64 cells; rays that meet instead of running in parallel bend it by the light's size over its
        // distance, and warps bend it by as much as their w changes over it
        for (int axis_index = 0; axis_index < 2; ++axis_index)
            ASSERT_NEAR(
                double(results[i].window[axis_index]), farthest[axis_index], (c.layer.warped ? 0.12 : 0.06) * farthest[axis_index] + 0.02)
                << scene::kind_name(of[i].kind()) << " " << i;
    }
}

TEST_F(SoftWindow, APanelsWindowIsThePenumbrasWidthSeenFromTheLight)
{
    // w_l (z_r - z_o) / z_o on the receiver, taken to the map's plane at unit depth, over a texel there
    const Light light = light_of(scene::RectLight{{0, 4, 0}, {0.75f, 0, 0}, {0, 0, 0.5f}});
    const shaders::LightMap map = map_of(light);
    std::vector<shaders::SoftCase> cases;
    for (const float z : {0.5f, 2.0f, 3.9f, 4.0f, 5.0f})
        cases.push_back({map.layers[4], shadow::light_constants(light, bounds), {1, 0, 2}, {0, 1, 0}, z});
    const auto results = run(cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const double z = double(cases[i].z), penumbra = z < 4.0 ? (4.0 - z) / z : 0.0;
        const bool turned = std::abs(map.layers[4].map_from_world[0][1]) > std::abs(map.layers[4].map_from_world[0][0]); // x runs along v
        const double texel = double(map.layers[4].texel_metres), x = 0.75 * penumbra / 4.0 / texel, z_width = 0.5 * penumbra / 4.0 / texel;
        EXPECT_NEAR(double(results[i].window.x), turned ? z_width : x, 1e-4 * x + 1e-5);
        EXPECT_NEAR(double(results[i].window.y), turned ? x : z_width, 1e-4 * x + 1e-5);
    }
}

} // namespace
} // namespace gnomon
