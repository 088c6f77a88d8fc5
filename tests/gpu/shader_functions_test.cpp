// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"
#include "twins.shared.h"

#include "shadow/scene_gpu.h"

#include <bit>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

class ShaderFunctions : public gpu::DeviceTest { };

TEST_F(ShaderFunctions, OctahedralNormalsComeBack)
{
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    std::vector<gpu::Vec4> inputs = {{0, 0, 1, 0}, {0, 0, -1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 0}, {0, 1, 0, 0}, {0, -1, 0, 0}};
    for (const float z : {1e-6f, -1e-6f, -0.999999f}) {
        const vec3 n = glm::normalize(vec3(0.6f, -0.8f, z));
        inputs.push_back({n.x, n.y, n.z, 0});
    }
    while (inputs.size() < 20000) {
        const vec3 n = glm::normalize(vec3(normal(random), normal(random), normal(random)));
        inputs.push_back({n.x, n.y, n.z, 0});
    }
    const auto outputs = gpu::run_glsl_function(device(), "tests/gpu/octahedral.comp", inputs);
    for (size_t i = 0; i < inputs.size(); ++i) {
        const vec3 in(inputs[i][0], inputs[i][1], inputs[i][2]), out(outputs[i][0], outputs[i][1], outputs[i][2]);
        ASSERT_NEAR(glm::length(out), 1.0f, 1e-5f);
        ASSERT_LT(glm::length(in - out), 1e-4f) << in.x << " " << in.y << " " << in.z; // the chord: radians, for small angles
        ASSERT_EQ(std::bit_cast<uint32_t>(outputs[i][3]), 0u)
            << "encoding again changes the code of " << in.x << " " << in.y << " " << in.z;
    }
}

/// shaders/random.glsl in C++.
uvec3 hash3(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
    return v;
}

TEST_F(ShaderFunctions, RandomNumbersAreTheSameBits)
{
    std::mt19937 random(2);
    std::vector<uvec3> cases = {{0, 0, 0}, {0xffffffffu, 0xffffffffu, 0xffffffffu}};
    for (uint32_t y = 0; y < 40; ++y)
        for (uint32_t x = 0; x < 40; ++x) cases.emplace_back(x, y, 65536u * (x % 3));
    while (cases.size() < 4000) cases.emplace_back(uint32_t(random()), uint32_t(random()), uint32_t(random()));
    const auto results = gpu::run_glsl_cases<shaders::RandomResult>(device(), "tests/gpu/random.comp", cases);
    vec2 sum(0);
    for (size_t i = 0; i < cases.size(); ++i) {
        const uvec3 h = hash3(cases[i]);
        ASSERT_EQ(results[i].hash, h);
        for (int k = 0; k < 2; ++k) {
            ASSERT_EQ(std::bit_cast<uint32_t>(results[i].unit[k]), std::bit_cast<uint32_t>(float(h[k] >> 8) / 16777216.0f));
            ASSERT_LT(results[i].unit[k], 1.0f);
        }
        sum += results[i].unit;
    }
    EXPECT_NEAR(sum.x / float(cases.size()), 0.5f, 0.02f);
    EXPECT_NEAR(sum.y / float(cases.size()), 0.5f, 0.02f);
}

TEST_F(ShaderFunctions, TransmittanceIsThatOfTheScene)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    scene::Scene scene;
    for (int i = 0; i < 60; ++i) {
        scene::Material m;
        m.alpha = scene::AlphaMode(i % 3);
        m.alpha_cutoff = unit(random);
        m.transmission = i % 4 == 0 ? 0.0f : i % 4 == 1 ? 1.0f : unit(random);
        m.thickness = i % 5 == 0 ? 0.0f : unit(random);
        if (i % 2) m.attenuation_distance = 0.1f + unit(random); // else infinite
        m.attenuation_color = i % 7 == 0 ? vec3(0, 1, 0.5f) : vec3(unit(random), unit(random), unit(random));
        m.double_sided = i % 11 == 0;
        scene.materials.push_back(m);
    }
    shadow::SceneGpu resources(device(), scene); // its packing is part of the twin
    std::vector<shaders::TransmittanceCase> cases;
    for (uint32_t m = 0; m < scene.materials.size(); ++m)
        for (int i = 0; i < 40; ++i) {
            vec4 base(unit(random), unit(random), unit(random), unit(random));
            if (i == 0) base = vec4(0);
            if (i == 1) base = vec4(1);
            if (i == 2) base = vec4(1.5f, -0.5f, 0.5f, 2); // vertex colours times factors may leave [0, 1]
            if (i == 3) base.w = scene.materials[m].alpha_cutoff;
            cases.push_back({m, base});
        }
    const auto results = gpu::run_glsl_cases<vec3>(device(), "tests/gpu/transmittance.comp", cases, &resources.materials());
    for (size_t i = 0; i < cases.size(); ++i) {
        const vec3 expected = scene::transmittance(scene.materials[cases[i].material], cases[i].base);
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(results[i][k], expected[k], 1e-5f) << "material " << cases[i].material << ", case " << i;
    }
}

} // namespace
} // namespace gnomon
