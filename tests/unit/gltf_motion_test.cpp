// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include "scene/animation.h"

namespace gnomon::scene {
namespace {

using json = nlohmann::json;

/// A triangle on node 0 with one animated property; keys at 0 and 2 seconds unless `times` says otherwise.
GltfBuilder animated(const char* path, const char* interpolation, int (*output)(GltfBuilder&), std::vector<float> times = {0, 2})
{
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}});
    const int input = b.scalars(times), values = output(b);
    b.push("animations",
        {{"samplers", {{{"input", input}, {"output", values}, {"interpolation", interpolation}}}},
            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return b;
}

vec3 origin_at(const GltfBuilder& b, double time) { return vec3(b.load({.time = time}).instances.at(0).world_from_object[3]); }

int two_places(GltfBuilder& b) { return b.vec3s({{1, 0, 0}, {3, 4, 0}}); }

TEST(gltf_motion, linear_translation_repeats)
{
    const GltfBuilder b = animated("translation", "LINEAR", two_places);
    expect_near(origin_at(b, 0.0), {1, 0, 0});
    expect_near(origin_at(b, 0.5), {1.5f, 1, 0});
    expect_near(origin_at(b, 1.75), {2.75f, 3.5f, 0});
    expect_near(origin_at(b, 4.5), {1.5f, 1, 0});
    expect_near(origin_at(b, -1.5), {1.5f, 1, 0});
}

TEST(gltf_motion, step_holds)
{
    const GltfBuilder b = animated("translation", "STEP", two_places, {0.5f, 2});
    expect_near(origin_at(b, 0.1), {1, 0, 0});
    expect_near(origin_at(b, 1.99), {1, 0, 0});
}

TEST(gltf_motion, cubic_spline_is_the_hermite_curve)
{
    // In-tangent, value, out-tangent at 0 and 2 s: from 1 with speed 5 to 3 with speed -1 (x).
    const GltfBuilder b = animated("translation", "CUBICSPLINE", [](GltfBuilder& g) {
        return g.vec3s({{9, 0, 0}, {1, 0, 0}, {5, 0, 0}, {-1, 0, 0}, {3, 0, 0}, {9, 0, 0}});
    });
    for (const double time : {0.5, 1.0, 1.5}) {
        const double t = time / 2;
        const double x
            = (1 + 2 * t) * (1 - t) * (1 - t) * 1 + t * (1 - t) * (1 - t) * 2 * 5 + t * t * (3 - 2 * t) * 3 + t * t * (t - 1) * 2 * -1;
        expect_near(origin_at(b, time), {x, 0, 0});
    }
}

TEST(gltf_motion, rotation_takes_the_shorter_way)
{
    // 0 and 90 degrees about z, the second with its sign turned round: halfway is 45 degrees.
    const GltfBuilder b = animated("rotation", "LINEAR", [](GltfBuilder& g) {
        const float h = std::sqrt(0.5f);
        return g.vec4s({{0, 0, 0, 1}, {0, 0, -h, -h}});
    });
    const mat4 m = b.load({.time = 1.0}).instances.at(0).world_from_object;
    expect_near(vec3(m * vec4(1, 0, 0, 0)), {std::sqrt(0.5f), std::sqrt(0.5f), 0});
}

TEST(gltf_motion, normalised_rotation_and_scale)
{
    const GltfBuilder turned = animated("rotation", "STEP", [](GltfBuilder& g) {
        return g.accessor(g.view(std::vector<int16_t>{0, 0, 32767, 0, 0, 0, 0, 32767}), "VEC4", 5122, 2, true);
    });
    expect_near(vec3(turned.load().instances.at(0).world_from_object * vec4(1, 0, 0, 0)), {-1, 0, 0});
    const GltfBuilder scaled = animated("scale", "LINEAR", [](GltfBuilder& g) { return g.vec3s({{1, 1, 1}, {3, 1, 1}}); });
    expect_near(scaled.load({.time = 1.0}).bounds().max, {2, 1, 0});
}

TEST(gltf_motion, morph_targets_by_node_mesh_and_animation)
{
    GltfBuilder b = animated("weights", "LINEAR", [](GltfBuilder& g) { return g.scalars({0, 0, 1, 0.5f}); });
    const int up = b.vec3s({{0, 0, 0}, {0, 0, 0}, {0, 4, 0}}), left = b.vec3s({{-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}});
    b.doc["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", left}}};
    expect_near(b.load({.time = 1.0}).bounds().max, {0.75f, 3, 0});
    expect_near(b.load({.time = 1.0}).bounds().min, {-0.25f, 0, 0});
    b.doc.erase("animations");
    b.doc["meshes"][0]["weights"] = {1.0, 0.0};
    expect_near(b.load().bounds().max, {1, 5, 0});
    b.doc["nodes"][0]["weights"] = {0.25, 0.0};
    expect_near(b.load().bounds().max, {1, 2, 0});
}

TEST(gltf_motion, morphed_normals)
{
    GltfBuilder b;
    const int normal = b.vec3s(std::vector<vec3>(3, vec3(0, 0, 1))), delta = b.vec3s(std::vector<vec3>(3, vec3(0, 1, -1)));
    b.triangle({{"attributes", {{"NORMAL", normal}}}, {"targets", {{{"NORMAL", delta}}}}});
    b.node({{"mesh", 0}, {"weights", {0.5}}});
    expect_near(b.load().meshes.at(0).normals.at(0), glm::normalize(vec3(0, 1, 1)));
}

/// Two joints: the root at the origin, and one at (0, 1, 0) that is turned by 90 degrees about z. Bound unturned.
GltfBuilder skinned()
{
    GltfBuilder b;
    const float h = std::sqrt(0.5f);
    const int position = b.vec3s({{0, 0, 0}, {0.5f, 0, 0}, {0, 2, 0}}), normal = b.vec3s({{0, 0, 1}, {0, 0, 1}, {1, 0, 0}});
    const int joints = b.accessor(b.view(std::vector<uint8_t>{0, 0, 0, 0, 0, 99, 0, 0, 1, 0, 0, 0}), "VEC4", 5121, 3);
    const int weights = b.vec4s({{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0, 0, 0}}); // the last adds up to a half
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
    std::vector<mat4> binds{mat4(1), glm::translate(mat4(1), vec3(0, -1, 0))};
    const int bind = b.accessor(b.view(binds), "MAT4", 5126, 2);
    b.node({{"children", {1}}, {"translation", {10, 0, 0}}});
    b.push("nodes", {{"translation", {0, 1, 0}}, {"rotation", {0, 0, h, h}}});
    b.node({{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}}); // which does not count
    b.push("skins", {{"joints", {0, 1}}, {"inverseBindMatrices", bind}});
    return b;
}

TEST(gltf_motion, skin)
{
    const Scene scene = skinned().load();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(scene.instances.at(0).world_from_object, mat4(1));
    expect_near(mesh.positions[0], {10, 0, 0});
    expect_near(mesh.positions[1], {10.5f, 0, 0});
    expect_near(mesh.positions[2], {9, 1, 0});
    expect_near(mesh.normals[2], {0, 1, 0});
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(gltf_motion, nodes_with_one_skin_share_its_mesh)
{
    GltfBuilder b = skinned();
    b.node({{"mesh", 0}, {"skin", 0}});
    b.node({{"mesh", 0}, {"skin", b.push("skins", {{"joints", {1, 1}}})}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh) << "which else would be read a thousand times for a thousand nodes";
    EXPECT_NE(scene.instances[0].mesh, scene.instances[2].mesh);
}

TEST(gltf_motion, a_mirrored_skin_keeps_its_outside)
{
    GltfBuilder b = skinned();
    const vec3 before = outside(b.load(), 0);
    b.doc["nodes"][0]["scale"] = {-1, 1, 1};
    const Scene scene = b.load();
    expect_near(outside(scene, 0), before);
    expect_near(scene.meshes[0].normals[0], {0, 0, 1});
}

TEST(gltf_motion, faults_in_a_skin_name_the_place)
{
    GltfBuilder b = skinned();
    b.doc["skins"][0]["joints"] = {0, 77};
    EXPECT_NE(b.load_error().find("skins[0].joints[1] refers to nodes[77]"), std::string::npos);
    b.doc["skins"][0]["joints"] = {0};
    EXPECT_NE(b.load_error().find("JOINTS_0 names joint 1 at vertex 2, but the skin has 1"), std::string::npos);
}

TEST(gltf_motion, faults_in_an_animation_leave_the_rest)
{
    const auto warning_with = [](const char* pointer, const json& value) {
        GltfBuilder b = animated("translation", "LINEAR", two_places);
        b.doc[json::json_pointer(pointer)] = value;
        const Scene scene = b.load({.time = 1.0});
        EXPECT_EQ(scene.instances.size(), 1u);
        return scene.warnings.empty() ? std::string() : scene.warnings.front();
    };
    EXPECT_NE(warning_with("/animations/0/samplers/0/output", 9).find("refers to accessors[9]"), std::string::npos);
    EXPECT_NE(warning_with("/animations/0/channels/0/sampler", 9).find("refers to sampler 9"), std::string::npos);
    EXPECT_NE(warning_with("/animations/0/channels/0/target/path", "rotation").find("without four numbers"), std::string::npos);
    EXPECT_NE(warning_with("/animations/0/channels/0/target/path", "colour").find("unknown property 'colour'"), std::string::npos);
    EXPECT_NE(warning_with("/animations/0/channels/0/target/node", 9).find("refers to nodes[9]"), std::string::npos);
    EXPECT_NE(warning_with("/accessors/2/count", 1).find("do not fit"), std::string::npos);
}

TEST(gltf_motion, the_longest_animation_tells_how_long_a_scene_moves)
{
    GltfBuilder b = animated("translation", "LINEAR", two_places, {0, 2.5f});
    const TemporaryFolder folder;
    base::write_text(folder / "made.gltf", b.gltf_text());
    EXPECT_EQ(animation_seconds((folder / "made.gltf").string()), 2.5);
    base::write_text(folder / "scene.json", R"({"model": "made.gltf"})");
    EXPECT_EQ(animation_seconds((folder / "scene.json").string()), 2.5);
    base::write_text(folder / "builtin.json", R"({"model": "balls"})");
    EXPECT_EQ(animation_seconds((folder / "builtin.json").string()), 0.0);
    EXPECT_EQ(animation_seconds("balls"), 0.0);
    b.push("animations", {{"samplers", {{{"input", 99}, {"output", 0}}}}, {"channels", json::array()}});
    base::write_text(folder / "broken.gltf", b.gltf_text());
    EXPECT_EQ(animation_seconds((folder / "broken.gltf").string()), 2.5) << "what is broken is left out";
}

} // namespace
} // namespace gnomon::scene
