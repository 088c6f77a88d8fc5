// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <gtest/gtest.h>

namespace gnomon::scene {
namespace {

Mesh square()
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    complete(mesh);
    return mesh;
}

TEST(scene_value, bounds_counts_and_first_primitives)
{
    Scene scene;
    EXPECT_TRUE(scene.bounds().empty());
    scene.meshes.push_back(square());
    scene.instances = {{0, mat4(1)}, {0, glm::translate(mat4(1), vec3(0, 0, 5))}};
    EXPECT_EQ(scene.triangle_count(), 4u);
    EXPECT_EQ(scene.first_primitives(), (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(scene.bounds().min, vec3(0, 0, 0));
    EXPECT_EQ(scene.bounds().max, vec3(2, 2, 5));
}

TEST(scene_value, transformed_takes_all_corners)
{
    Bounds box;
    box.add(vec3(-1));
    box.add(vec3(1, 2, 3));
    const Bounds turned = transformed(box, glm::rotate(mat4(1), pi / 2, vec3(0, 0, 1)));
    EXPECT_NEAR(turned.min.x, -2.0f, 1e-6f);
    EXPECT_NEAR(turned.max.x, 1.0f, 1e-6f);
    EXPECT_NEAR(turned.max.y, 1.0f, 1e-6f);
    EXPECT_NEAR(turned.max.z, 3.0f, 1e-6f);
    EXPECT_TRUE(transformed(Bounds{}, mat4(1)).empty());
}

TEST(scene_value, complete_weights_normals_by_area)
{
    Mesh mesh;
    // Two triangles share the edge x = z = 0: one of area 2 facing +z, one of area 1/2 facing -x... whose normal is (-1, 0, 0).
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    complete(mesh);
    const vec3 shared = glm::normalize(vec3(0.5f, 0, 2));
    EXPECT_LT(glm::length(mesh.normals[0] - shared), 1e-6f);
    EXPECT_LT(glm::length(mesh.normals[1] - vec3(0, 0, 1)), 1e-6f);
    EXPECT_EQ(mesh.bounds.max, vec3(4, 1, 1));
}

TEST(scene_value, complete_keeps_given_normals_and_survives_flat_triangles)
{
    Mesh mesh = square();
    mesh.normals.assign(4, vec3(1, 0, 0));
    complete(mesh);
    EXPECT_EQ(mesh.normals[0], vec3(1, 0, 0));
    mesh.normals.clear();
    mesh.positions.assign(4, vec3(7));
    complete(mesh);
    for (const vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
}

TEST(scene_value, transmittance_of_each_kind)
{
    const vec4 half_red(1, 0, 0, 0.5f);
    Material m;
    EXPECT_EQ(transmittance(m, half_red), vec3(0));
    m.alpha = AlphaMode::mask;
    EXPECT_EQ(transmittance(m, half_red), vec3(0));
    EXPECT_EQ(transmittance(m, vec4(1, 0, 0, 0.49f)), vec3(1));
    m.alpha = AlphaMode::blend;
    EXPECT_EQ(transmittance(m, half_red), vec3(0.5f, 0.25f, 0.25f));
    EXPECT_EQ(transmittance(m, vec4(1, 0, 0, 0)), vec3(1));
    EXPECT_EQ(transmittance(m, vec4(1, 0, 0, 1)), vec3(0));
    m.alpha = AlphaMode::opaque;
    m.transmission = 0.5f;
    EXPECT_EQ(transmittance(m, vec4(1, 0.5f, 0, 1)), vec3(0.5f, 0.25f, 0));
    m.thickness = 2.0f;
    m.attenuation_color = {0.5f, 1, 0};
    m.attenuation_distance = 1.0f;
    EXPECT_EQ(transmittance(m, vec4(1)), vec3(0.125f, 0.5f, 0));
    m.alpha = AlphaMode::mask; // cut-out glass: clear where it is cut, glass where it is not
    EXPECT_EQ(transmittance(m, vec4(1, 1, 1, 0)), vec3(1));
    EXPECT_EQ(transmittance(m, vec4(1)), vec3(0.125f, 0.5f, 0));
}

} // namespace
} // namespace gnomon::scene
