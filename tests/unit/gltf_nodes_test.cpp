// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

namespace gnomon::scene {
namespace {

using json = nlohmann::json;

vec3 placed(const Scene& scene, size_t instance, vec3 p) { return vec3(scene.instances[instance].world_from_object * vec4(p, 1.0f)); }

TEST(gltf_nodes, hierarchy_of_trs_and_matrix)
{
    GltfBuilder b;
    b.triangle();
    const double h = std::sqrt(0.5);
    const int child = b.push("nodes", {{"mesh", 0}, {"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}});
    const int middle = b.push("nodes", {{"rotation", {0, 0, h, h}}, {"children", {child}}}); // a quarter turn about z
    b.node({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}, {"children", {middle}}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 1u);
    expect_near(placed(scene, 0, {0, 0, 0}), {10, 21, 30});
    expect_near(placed(scene, 0, {1, 0, 0}), {10, 23, 30});
    expect_near(placed(scene, 0, {0, 1, 0}), {8, 21, 30});
}

TEST(gltf_nodes, far_places_cancel_in_double)
{
    GltfBuilder b;
    b.triangle();
    const int child = b.push("nodes", {{"mesh", 0}, {"translation", {-1e9 + 0.125, 0, 0}}});
    b.node({{"translation", {1e9, 0, 0}}, {"children", {child}}});
    expect_near(placed(b.load(), 0, {0, 0, 0}), {0.125f, 0, 0}, 1e-6f);
}

TEST(gltf_nodes, one_mesh_is_shared_by_its_instances)
{
    GltfBuilder b;
    b.triangle();
    for (int i = 0; i < 3; ++i) b.node({{"mesh", 0}, {"translation", {i, 0, 0}}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.first_primitives(), (std::vector<uint32_t>{0, 1, 2}));
}

TEST(gltf_nodes, gpu_instancing)
{
    GltfBuilder b;
    b.triangle();
    const float h = std::sqrt(0.5f);
    const int t = b.vec3s({{1, 0, 0}, {0, 2, 0}}), r = b.vec4s({{0, 0, 0, 1}, {0, 0, h, h}}), s = b.vec3s({{1, 1, 1}, {3, 3, 3}});
    b.node({{"mesh", 0}, {"translation", {0, 0, 5}},
        {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", t}, {"ROTATION", r}, {"SCALE", s}}}}}}}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 2u);
    expect_near(placed(scene, 0, {1, 0, 0}), {2, 0, 5});
    expect_near(placed(scene, 1, {1, 0, 0}), {0, 5, 5});
}

TEST(gltf_nodes, gpu_instancing_without_data_or_agreement_is_refused)
{
    GltfBuilder b;
    b.triangle();
    const int t = b.vec3s({{1, 0, 0}, {0, 2, 0}}), s = b.vec3s({{1, 1, 1}});
    b.node({{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", t}, {"SCALE", s}}}}}}}});
    EXPECT_NE(b.load_error().find("differ in their numbers of instances"), std::string::npos);
    b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].erase("SCALE");
    b.doc["accessors"][size_t(t)].erase("bufferView");
    b.doc["accessors"][size_t(t)]["count"] = 10000000;
    EXPECT_NE(b.load_error().find("has no data"), std::string::npos);
}

TEST(gltf_nodes, mirrored_instances_keep_their_outside)
{
    GltfBuilder b;
    const int normal = b.vec3s(std::vector<vec3>(3, vec3(0, 0, 1)));
    b.triangle({{"attributes", {{"NORMAL", normal}}}});
    b.node({{"mesh", 0}});
    b.node({{"mesh", 0}, {"scale", {-1, 1, 1}}});
    b.node({{"mesh", 0}, {"scale", {1, -2, 1}}});
    b.node({{"mesh", 0}, {"scale", {-1, -1, 1}}});
    b.node({{"mesh", 0}, {"scale", {1, 1, -1}}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 5u);
    EXPECT_EQ(scene.meshes.size(), 2u) << "one mirrored copy for all";
    for (size_t i = 0; i < 5; ++i) {
        const Instance& instance = scene.instances[i];
        EXPECT_GT(glm::determinant(mat3(instance.world_from_object)), 0.0f);
        const vec3 away = i == 4 ? vec3(0, 0, -1) : vec3(0, 0, 1);
        expect_near(outside(scene, i), away);
        expect_near(
            glm::normalize(glm::inverse(glm::transpose(mat3(instance.world_from_object))) * scene.meshes[size_t(instance.mesh)].normals[0]),
            away);
    }
    const Bounds box = transformed(scene.meshes[size_t(scene.instances[2].mesh)].bounds, scene.instances[2].world_from_object);
    expect_near(box.min, {0, -2, 0});
    expect_near(box.max, {1, 0, 0});
}

TEST(gltf_nodes, a_mesh_shown_only_mirrored_is_not_kept_twice)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}, {"scale", {-1, 1, 1}}});
    b.node({{"mesh", 0}, {"scale", {-1, 1, 1}}, {"translation", {0, 0, 1}}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    for (size_t i = 0; i < 2; ++i) expect_near(outside(scene, i), {0, 0, 1});
    expect_near(scene.bounds().min, {-1, 0, 0});
}

TEST(gltf_nodes, scenes_by_number)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const int other = b.push("nodes", {{"mesh", 0}, {"translation", {7, 0, 0}}});
    b.push("scenes", {{"nodes", {other}}});
    b.doc["scene"] = 1;
    expect_near(b.load().bounds().min, {7, 0, 0});
    expect_near(b.load({.gltf_scene = 0}).bounds().min, {0, 0, 0});
    const std::string error = b.load_error({.gltf_scene = 2});
    EXPECT_NE(error.find("there is no scene 2; the file has 2"), std::string::npos) << error;
    b.doc.erase("scene"), b.doc.erase("scenes");
    EXPECT_EQ(b.load().instances.size(), 2u) << "without scenes all nodes are shown";
}

TEST(gltf_nodes, loops_and_second_parents_are_cut)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"children", {1}}});
    b.push("nodes", {{"children", {2}}, {"mesh", 0}});
    b.push("nodes", {{"children", {0, 3}}});
    b.push("nodes", {{"mesh", 0}});
    b.push("nodes", {{"children", {3}}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_TRUE(any_contains(scene.warnings, "is a descendant of itself"));
    EXPECT_TRUE(any_contains(scene.warnings, "nodes[4].children[0] names nodes[3], which nodes[2] has already"));
}

TEST(gltf_nodes, a_chain_of_a_hundred_thousand_nodes)
{
    GltfBuilder b;
    b.triangle();
    constexpr int length = 100000;
    b.node({{"children", {1}}});
    json& nodes = b.doc["nodes"];
    for (int i = 1; i < length; ++i) nodes.push_back({{"children", {i + 1}}, {"translation", {0.001, 0, 0}}});
    nodes.push_back({{"mesh", 0}});
    expect_near(b.load().bounds().min, {99.999f, 0, 0}, 1e-3f);
}

TEST(gltf_nodes, flat_and_endless_transforms_are_left_out)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    b.node({{"mesh", 0}, {"scale", {1, 0, 1}}});
    b.node({{"mesh", 0}, {"scale", {1e300, 1e300, 1e300}}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(any_contains(scene.warnings, "nodes[1] has a transform that flattens its mesh"));
    EXPECT_TRUE(any_contains(scene.warnings, "nodes[2] has a transform that is not finite"));
}

TEST(gltf_nodes, lights)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    b.doc["extensions"]["KHR_lights_punctual"]["lights"]
        = {{{"type", "directional"}, {"name", "sun"}, {"color", {1, 0.5, 0.25}}, {"intensity", 3}},
            {{"type", "point"}, {"intensity", 20}, {"range", 5}},
            {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
            {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.4}}}}};
    const double h = std::sqrt(0.5);
    for (int i = 0; i < 5; ++i) // a quarter turn about x: -z becomes +y... seen from there, the light travels up
        b.node({{"translation", {1, 2, 3}}, {"rotation", {h, 0, 0, h}}, {"scale", {4, 4, 4}},
            {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "sun");
    expect_near(scene.lights[0].color, {1, 0.5f, 0.25f});
    EXPECT_FLOAT_EQ(scene.lights[0].intensity.value(), 3.0f);
    expect_near(std::get<DirectionalLight>(scene.lights[0].shape).direction, {0, 1, 0});
    expect_near(std::get<PointLight>(scene.lights[1].shape).position, {1, 2, 3});
    const auto& spot = std::get<SpotLight>(scene.lights[2].shape);
    expect_near(spot.position, {1, 2, 3});
    expect_near(spot.direction, {0, 1, 0});
    EXPECT_FLOAT_EQ(spot.inner_angle, 0.2f);
    EXPECT_FLOAT_EQ(spot.outer_angle, 0.4f);
    EXPECT_FALSE(scene.lights[2].intensity.has_value());
    EXPECT_TRUE(any_contains(scene.warnings, "cone angles"));
    EXPECT_TRUE(any_contains(scene.warnings, "refers to light 4"));
}

TEST(gltf_nodes, cameras)
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    b.doc["cameras"] = {{{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.25}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"zfar", 100}, {"znear", 0}}}}};
    b.node({{"camera", 0}, {"translation", {0, 0, 10}}});
    const double h = std::sqrt(0.5);
    b.node({{"camera", 1}, {"translation", {0, 10, 0}}, {"rotation", {-h, 0, 0, h}}, {"name", "plan"}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "eye");
    EXPECT_FLOAT_EQ(scene.cameras[0].fov_y, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near, 0.25f);
    EXPECT_FLOAT_EQ(scene.cameras[0].half_height, 0.0f);
    expect_near(scene.cameras[0].eye, {0, 0, 10});
    expect_near(scene.cameras[0].target, {0, 0, 0});
    expect_near(scene.cameras[0].up, {0, 1, 0});
    EXPECT_EQ(scene.cameras[1].name, "plan");
    EXPECT_FLOAT_EQ(scene.cameras[1].half_height, 3.0f);
    expect_near(glm::normalize(scene.cameras[1].target - scene.cameras[1].eye), {0, -1, 0});
    expect_near(scene.cameras[1].up, {0, 0, -1});
}

} // namespace
} // namespace gnomon::scene
