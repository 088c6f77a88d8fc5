// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

namespace gnomon::scene {
namespace {

using json = nlohmann::json;

std::vector<uint32_t> loaded_indices(GltfBuilder& b)
{
    b.node({{"mesh", 0}});
    return b.load().meshes.at(0).indices;
}

// Five points whose normals keep the vertices apart and in order.
json zigzag(GltfBuilder& b, int mode)
{
    return {{"mode", mode},
        {"attributes",
            {{"POSITION", b.vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}})},
                {"NORMAL", b.vec3s(std::vector<vec3>(5, vec3(0, 0, 1)))}}}};
}

TEST(gltf_mesh, list_without_indices)
{
    GltfBuilder b;
    b.mesh(zigzag(b, 4));
    EXPECT_EQ(loaded_indices(b), (std::vector<uint32_t>{0, 1, 2}));
}

TEST(gltf_mesh, strip_keeps_the_winding)
{
    GltfBuilder b;
    b.mesh(zigzag(b, 5));
    EXPECT_EQ(loaded_indices(b), (std::vector<uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
}

TEST(gltf_mesh, fan)
{
    GltfBuilder b;
    b.mesh(zigzag(b, 6));
    EXPECT_EQ(loaded_indices(b), (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST(gltf_mesh, indices_of_every_width)
{
    for (const int component : {5121, 5123, 5125}) {
        GltfBuilder b;
        json p = zigzag(b, 4);
        const int view = component == 5121 ? b.view(std::vector<uint8_t>{4, 3, 2})
            : component == 5123            ? b.view(std::vector<uint16_t>{4, 3, 2})
                                           : b.view(std::vector<uint32_t>{4, 3, 2});
        p["indices"] = b.accessor(view, "SCALAR", component, 3);
        b.mesh(p);
        b.node({{"mesh", 0}});
        const Mesh mesh = b.load().meshes.at(0);
        ASSERT_EQ(mesh.positions.size(), 3u) << "vertices 0 and 1 are unused";
        expect_near(mesh.positions[mesh.indices[0]], {0, 2, 0});
        expect_near(mesh.positions[mesh.indices[1]], {1, 1, 0});
        expect_near(mesh.positions[mesh.indices[2]], {0, 1, 0});
    }
}

TEST(gltf_mesh, points_are_left_out_with_a_warning)
{
    GltfBuilder b;
    b.triangle();
    b.mesh(zigzag(b, 0));
    b.node({{"mesh", 0}});
    b.node({{"mesh", 1}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.triangle_count(), 1u);
    EXPECT_TRUE(any_contains(scene.warnings, "meshes[1].primitives[0] holds points or lines"));
}

TEST(gltf_mesh, sparse_with_and_without_base)
{
    for (const bool base : {true, false}) {
        GltfBuilder b;
        b.triangle();
        const int indices = b.view(std::vector<uint16_t>{1, 2}), values = b.view(std::vector<vec3>{{5, 0, 0}, {0, 7, 0}});
        json& a = b.doc["accessors"][0];
        a["sparse"] = {{"count", 2}, {"indices", {{"bufferView", indices}, {"componentType", 5123}}}, {"values", {{"bufferView", values}}}};
        if (!base) a.erase("bufferView");
        b.node({{"mesh", 0}});
        const Mesh mesh = b.load().meshes.at(0);
        expect_near(mesh.positions[0], {0, 0, 0});
        expect_near(mesh.positions[1], {5, 0, 0});
        expect_near(mesh.positions[2], {0, 7, 0});
    }
}

TEST(gltf_mesh, interleaved_normalised_and_quantised)
{
    GltfBuilder b;
    // Positions as unnormalised i16, normals as normalised i8, uvs as normalised u16, each vertex 16 bytes.
    struct Vertex {
        int16_t position[4];
        int8_t normal[4];
        uint16_t uv[2];
    };
    const int view = b.view(std::vector<Vertex>{{{0, 0, 0, 0}, {0, 0, 127, 0}, {0, 65535}}, {{-200, 0, 0, 0}, {0, -128, 0, 0}, {65535, 0}},
        {{0, 300, 0, 0}, {0, 0, 127, 0}, {0, 0}}});
    b.doc["bufferViews"][0]["byteStride"] = sizeof(Vertex);
    const int position = b.accessor(view, "VEC3", 5122, 3), normal = b.accessor(view, "VEC3", 5120, 3, true),
              uv = b.accessor(view, "VEC2", 5123, 3, true);
    b.doc["accessors"][size_t(normal)]["byteOffset"] = 8;
    b.doc["accessors"][size_t(uv)]["byteOffset"] = 12;
    b.doc["extensionsRequired"] = {"KHR_mesh_quantization"};
    b.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}}});
    b.node({{"mesh", 0}, {"scale", {0.01, 0.01, 0.01}}});
    const Scene scene = b.load();
    const Mesh& mesh = scene.meshes.at(0);
    expect_near(mesh.positions[1], {-200, 0, 0});
    expect_near(mesh.positions[2], {0, 300, 0});
    expect_near(mesh.normals[1], {0, -1, 0});
    expect_near(scene.bounds().max, {0, 3, 0});
    EXPECT_TRUE(mesh.uvs.empty()) << "no texture asks for them";
}

TEST(gltf_mesh, vertex_colors_of_every_form)
{
    for (const int form : {0, 1, 2}) {
        GltfBuilder b;
        const int color = form == 0 ? b.vec3s({{1, 0, 0}, {0, 0.5f, 0}, {0, 0, 2}})
            : form == 1
            ? b.accessor(b.view(std::vector<uint32_t>{0xff0000ff, 0xff008000, 0xffff0000}), "VEC4", 5121, 3, true)
            : b.accessor(b.view(std::vector<uint16_t>{65535, 0, 0, 65535, 0, 32896, 0, 65535, 0, 0, 65535, 65535}), "VEC4", 5123, 3, true);
        b.triangle({{"attributes", {{"COLOR_0", color}}}});
        b.node({{"mesh", 0}});
        EXPECT_EQ(b.load().meshes.at(0).colors, (std::vector<uint32_t>{0xff0000ff, 0xff008000, 0xffff0000})) << form;
    }
}

TEST(gltf_mesh, missing_normals_are_flat)
{
    GltfBuilder b;
    const int position = b.vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    b.mesh({{"attributes", {{"POSITION", position}}}, {"indices", b.indices({0, 1, 2, 0, 2, 3})}});
    b.node({{"mesh", 0}});
    const Mesh mesh = b.load().meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 6u);
    for (size_t i = 0; i < 6; ++i) expect_near(mesh.normals[mesh.indices[i]], i < 3 ? vec3(0, 0, 1) : vec3(1, 0, 0));
}

TEST(gltf_mesh, broken_normals_are_replaced)
{
    GltfBuilder b;
    const int normal = b.vec3s({{0, 0, 3}, {0, 0, 0}, {NAN, 0, 0}});
    b.triangle({{"attributes", {{"NORMAL", normal}}}});
    b.node({{"mesh", 0}});
    const Mesh mesh = b.load().meshes.at(0);
    for (const vec3& n : mesh.normals) expect_near(n, {0, 0, 1});
}

TEST(gltf_mesh, triangles_with_broken_positions_are_dropped)
{
    GltfBuilder b;
    const int position = b.vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {INFINITY, 0, 0}, {NAN, 0, 0}, {1e20f, 0, 0}});
    b.mesh({{"attributes", {{"POSITION", position}}}, {"indices", b.indices({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 0, 0, 1})}});
    b.node({{"mesh", 0}});
    const Scene scene = b.load();
    EXPECT_EQ(scene.triangle_count(), 1u);
    expect_near(scene.bounds().max, {1, 1, 0});
    EXPECT_TRUE(any_contains(scene.warnings, "has 3 triangles with positions that are not finite"));
}

TEST(gltf_mesh, zero_area_is_kept)
{
    GltfBuilder b;
    const int position = b.vec3s({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
    b.mesh({{"attributes", {{"POSITION", position}}}});
    b.node({{"mesh", 0}});
    EXPECT_EQ(b.load().triangle_count(), 1u);
}

TEST(gltf_mesh, index_out_of_range_names_the_place)
{
    GltfBuilder b;
    b.triangle({{"indices", b.indices({0, 1, 3})}});
    b.node({{"mesh", 0}});
    const std::string error = b.load_error();
    EXPECT_NE(
        error.find("meshes[0].primitives[0].indices holds the index 3 at element 2, but the primitive has 3 vertices"), std::string::npos)
        << error;
    EXPECT_NE(error.find("made.gltf"), std::string::npos);
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(gltf_mesh, counts_beyond_the_data_are_refused)
{
    for (const double count : {4.0, 4e9, 1e15}) {
        GltfBuilder b;
        b.triangle();
        b.doc["accessors"][0]["count"] = count;
        b.node({{"mesh", 0}});
        EXPECT_NE(b.load_error().find("accessors[0]"), std::string::npos);
        b.doc["accessors"][0].erase("bufferView");
        b.doc["accessors"][0]["sparse"]
            = {{"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
        if (count > 4.0) {
            EXPECT_NE(b.load_error().find("too many"), std::string::npos);
        }
    }
}

} // namespace
} // namespace gnomon::scene
