// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"
#include "twins.shared.h"

#include "scene/light.h"
#include "shadow/light_constants.h"

#include <cmath>
#include <random>

namespace gnomon {
namespace {

class LightShader : public gpu::DeviceTest { };

/// Lights of one kind: random ones, and those whose axes lie where an orthonormal basis is delicate.
std::vector<scene::LightShape> shapes(scene::LightKind kind, std::mt19937& random)
{
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f), positive(0.05f, 1.2f);
    std::vector<vec3> axes = {{0, -1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {-0.6f, -0.8f, -0.0f},
        {0.6f, -0.8f, 0.0f}, glm::normalize(vec3(1e-4f, 2e-4f, -1)), glm::normalize(vec3(1e-4f, 2e-4f, 1))};
    while (axes.size() < 40) axes.push_back(glm::normalize(vec3(uniform(random), uniform(random), uniform(random)) + 1e-3f));
    std::vector<scene::LightShape> out;
    for (const vec3 axis : axes) {
        const vec3 position = 4.0f * vec3(uniform(random), uniform(random), uniform(random));
        const float radius = out.size() % 5 == 4 ? 0.0f : out.size() % 5 == 3 ? 0.00465f : positive(random);
        switch (kind) {
        case scene::LightKind::directional:
            out.push_back(scene::DirectionalLight{axis, radius});
            break;
        case scene::LightKind::spot:
            out.push_back(scene::SpotLight{position, axis, 0.1f, positive(random), radius});
            break;
        case scene::LightKind::point:
            out.push_back(scene::PointLight{position, radius});
            break;
        case scene::LightKind::rect: {
            const mat3 basis = scene::basis_about(axis);
            out.push_back(scene::RectLight{position, positive(random) * basis[0], positive(random) * basis[1]});
            break;
        }
        case scene::LightKind::disk:
            out.push_back(scene::DiskLight{position, axis, std::max(radius, 0.01f)});
            break;
        }
    }
    return out;
}

/// How far p is from the edge of what the light reaches, as a sine; large where there is no edge.
float edge_distance(const scene::Light& light, const shaders::Light& c, vec3 p)
{
    if (light.kind() == scene::LightKind::directional || light.kind() == scene::LightKind::point) return 1.0f;
    const vec3 from = glm::normalize(p - c.position);
    return std::abs(glm::dot(from, c.direction) - (light.kind() == scene::LightKind::spot ? c.cos_outer : 0.0f));
}

TEST_F(LightShader, PointsAndReachAreTheSameOnBothSides)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-6.0f, 6.0f), unit(0.0f, 1.0f);
    std::vector<scene::Light> lights;
    std::vector<shaders::LightCase> cases;
    for (int kind = 0; kind < scene::light_kind_count; ++kind)
        for (const scene::LightShape& shape : shapes(scene::LightKind(kind), random)) {
            scene::Light light;
            light.shape = shape;
            const shaders::Light constants = shadow::light_constants(light, {{-1, -1, -1}, {1, 1, 1}});
            for (int i = 0; i < 50; ++i) {
                vec2 u(unit(random), unit(random));
                if (i < 5) u = vec2(i % 2, i / 2) * 0.5f; // corners, edges and the centre of the square
                lights.push_back(light);
                cases.push_back({constants, vec3(uniform(random), uniform(random), uniform(random)), u});
            }
        }
    const auto results = gpu::run_glsl_cases<shaders::LightResult>(device(), "tests/gpu/light.comp", cases);
    size_t reached = 0, compared = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const shaders::LightCase& c = cases[i];
        const vec4 point = scene::light_point(lights[i], c.p_world, c.u);
        SCOPED_TRACE(testing::Message() << scene::kind_name(lights[i].kind()) << " light " << i << ", u " << c.u.x << " " << c.u.y);
        ASSERT_EQ(results[i].point.w, point.w);
        // of the coordinates' own size; a direction's is 1
        const float size = point.w == 0.0f ? 1.0f : 1.0f + glm::length(c.light.position);
        ASSERT_LE(glm::length(vec3(results[i].point - point)), 1e-5f * size);
        if (c.light.kind == LIGHT_DIRECTIONAL) {
            ASSERT_EQ(vec3(results[i].towards), -c.light.direction);
        } else {
            const vec3 d = c.light.position - c.p_world;
            ASSERT_NEAR(results[i].towards.w, glm::length(d), 1e-5f * glm::length(d));
            ASSERT_LE(glm::length(vec3(results[i].towards) * results[i].towards.w - d), 1e-5f * glm::length(d));
        }
        if (edge_distance(lights[i], c.light, c.p_world) < 1e-5f) continue; // the last bits decide
        ASSERT_EQ(results[i].reaches != 0, scene::reaches(lights[i], c.p_world));
        reached += results[i].reaches, ++compared;
    }
    EXPECT_GT(reached, compared / 4);
    EXPECT_LT(reached, compared * 9 / 10);
}

TEST_F(LightShader, ASphereSeenFromItsCentreIsItsCentre)
{
    scene::Light light;
    light.shape = scene::PointLight{{1, 2, 3}, 0.5f};
    const std::vector<shaders::LightCase> cases = {{shadow::light_constants(light, {{-1, -1, -1}, {1, 1, 1}}), {1, 2, 3}, {0.9f, 0.2f}}};
    EXPECT_EQ(gpu::run_glsl_cases<shaders::LightResult>(device(), "tests/gpu/light.comp", cases)[0].point, vec4(1, 2, 3, 1));
}

} // namespace
} // namespace gnomon
