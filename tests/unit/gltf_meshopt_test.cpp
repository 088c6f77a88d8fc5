// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include <meshoptimizer.h>

namespace gnomon::scene {
namespace {

using json = nlohmann::json;

/// A buffer view of `count` elements that are there in compressed form alone; the fallback buffer has no data.
int compressed_view(
    GltfBuilder& b, std::vector<unsigned char> packed, size_t count, size_t stride, const char* mode, const char* filter = "NONE")
{
    const int raw = b.view(packed);
    const json place = b.doc["bufferViews"][size_t(raw)];
    return b.push("bufferViews",
        {{"buffer", 1}, {"byteLength", count * stride}, {"byteStride", stride},
            {"extensions",
                {{"EXT_meshopt_compression",
                    {{"buffer", 0}, {"byteOffset", place["byteOffset"]}, {"byteLength", place["byteLength"]}, {"byteStride", stride},
                        {"count", count}, {"mode", mode}, {"filter", filter}}}}}});
}

std::vector<unsigned char> encode_vertices(const void* values, size_t count, size_t stride)
{
    std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), values, count, stride));
    return out;
}

/// A grid of 2 * 8 * 8 triangles at z = 0, all of it compressed.
struct Grid {
    std::vector<vec3> positions;
    std::vector<uint32_t> indices;
    Grid()
    {
        for (uint32_t y = 0; y <= 8; ++y)
            for (uint32_t x = 0; x <= 8; ++x) positions.emplace_back(x, y, 0);
        for (uint32_t y = 0; y < 8; ++y)
            for (uint32_t x = 0; x < 8; ++x) {
                const uint32_t a = y * 9 + x;
                indices.insert(indices.end(), {a, a + 1, a + 9, a + 1, a + 10, a + 9});
            }
    }
    int indices_view(GltfBuilder& b, bool sequence) const
    {
        std::vector<unsigned char> out(1 << 16);
        out.resize(sequence ? meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size())
                            : meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
        return compressed_view(b, out, indices.size(), 4, sequence ? "INDICES" : "TRIANGLES");
    }
};

Mesh load_one(GltfBuilder& b)
{
    b.doc["extensionsRequired"] = {"EXT_meshopt_compression"};
    b.doc["buffers"] = {json::object(), {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    b.node({{"mesh", 0}});
    return b.load().meshes.at(0);
}

TEST(gltf_meshopt, vertices_and_both_index_codes)
{
    const Grid grid;
    for (const bool sequence : {false, true}) {
        GltfBuilder b;
        const int position = compressed_view(b, encode_vertices(grid.positions.data(), 81, 12), 81, 12, "ATTRIBUTES");
        const int index = grid.indices_view(b, sequence);
        const std::vector<vec3> up(81, vec3(0, 0, 1));
        const int attribute = b.accessor(position, "VEC3", 5126, 81), normal = b.vec3s(up);
        b.mesh({{"attributes", {{"POSITION", attribute}, {"NORMAL", normal}}},
            {"indices", b.accessor(index, "SCALAR", 5125, grid.indices.size())}});
        const Mesh mesh = load_one(b);
        EXPECT_EQ(mesh.positions, grid.positions);
        ASSERT_EQ(mesh.triangle_count(), 128u);
        double area = 0; // the codec may turn the corners of a triangle, never its side
        for (size_t t = 0; t < 128; ++t) {
            const uint32_t* i = &mesh.indices[t * 3];
            area += double(glm::cross(mesh.positions[i[1]] - mesh.positions[i[0]], mesh.positions[i[2]] - mesh.positions[i[0]]).z) / 2;
        }
        EXPECT_NEAR(area, 64.0, 1e-9);
    }
}

TEST(gltf_meshopt, octahedral_and_exponential_filters)
{
    const Grid grid;
    GltfBuilder b;
    std::vector<float> padded;
    std::vector<vec4> directions;
    for (size_t i = 0; i < 81; ++i) {
        padded.insert(padded.end(), {grid.positions[i].x, grid.positions[i].y, 0.25f});
        directions.emplace_back(glm::normalize(vec3(float(i) - 40.0f, 5.0f, float(i % 9) - 4.0f)), 0.0f);
    }
    std::vector<unsigned char> exponents(81 * 12), octahedral(81 * 8);
    meshopt_encodeFilterExp(exponents.data(), 81, 12, 15, padded.data());
    meshopt_encodeFilterOct(octahedral.data(), 81, 8, 16, &directions[0].x);
    const int position = compressed_view(b, encode_vertices(exponents.data(), 81, 12), 81, 12, "ATTRIBUTES", "EXPONENTIAL");
    const int normal = compressed_view(b, encode_vertices(octahedral.data(), 81, 8), 81, 8, "ATTRIBUTES", "OCTAHEDRAL");
    const int index = grid.indices_view(b, false);
    const int a = b.accessor(position, "VEC3", 5126, 81), n = b.accessor(normal, "VEC3", 5122, 81, true);
    b.mesh({{"attributes", {{"POSITION", a}, {"NORMAL", n}}}, {"indices", b.accessor(index, "SCALAR", 5125, grid.indices.size())}});
    const Mesh mesh = load_one(b);
    for (size_t i = 0; i < 81; ++i) {
        expect_near(mesh.positions[i], {grid.positions[i].x, grid.positions[i].y, 0.25f}, 1e-3f);
        expect_near(mesh.normals[i], vec3(directions[i].x, directions[i].y, directions[i].z), 1e-3f);
    }
}

TEST(gltf_meshopt, quaternion_filter_in_instancing)
{
    GltfBuilder b;
    b.triangle();
    const float half = std::sqrt(0.5f);
    const std::vector<vec4> turns{{0, 0, half, half}, {0, half, 0, half}, {0, 0, 0, 1}, {half, 0, 0, half}};
    std::vector<unsigned char> packed(turns.size() * 8);
    meshopt_encodeFilterQuat(packed.data(), turns.size(), 8, 16, &turns[0].x);
    const int view = compressed_view(b, encode_vertices(packed.data(), turns.size(), 8), turns.size(), 8, "ATTRIBUTES", "QUATERNION");
    const int rotation = b.accessor(view, "VEC4", 5122, turns.size(), true);
    b.doc["buffers"] = {json::object(), {{"byteLength", 1 << 20}}};
    b.node({{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"ROTATION", rotation}}}}}}}});
    const Scene scene = b.load();
    ASSERT_EQ(scene.instances.size(), 4u);
    expect_near(vec3(scene.instances[0].world_from_object * vec4(1, 0, 0, 0)), {0, 1, 0}, 1e-3f);
    expect_near(vec3(scene.instances[1].world_from_object * vec4(1, 0, 0, 0)), {0, 0, -1}, 1e-3f);
    expect_near(vec3(scene.instances[3].world_from_object * vec4(0, 1, 0, 0)), {0, 0, 1}, 1e-3f);
}

TEST(gltf_meshopt, broken_codes_are_refused)
{
    const Grid grid;
    const auto error_with = [&](const char* key, const json& value) {
        GltfBuilder b;
        const int position = compressed_view(b, encode_vertices(grid.positions.data(), 81, 12), 81, 12, "ATTRIBUTES");
        b.mesh({{"attributes", {{"POSITION", b.accessor(position, "VEC3", 5126, 81)}}}});
        b.doc["bufferViews"][size_t(position)]["extensions"]["EXT_meshopt_compression"][key] = value;
        b.node({{"mesh", 0}});
        return b.load_error();
    };
    EXPECT_NE(error_with("count", 1e9).find("can hold"), std::string::npos);
    EXPECT_NE(error_with("byteStride", 13).find("byteStride"), std::string::npos);
    EXPECT_NE(error_with("mode", "SIDEWAYS").find("mode 'SIDEWAYS'"), std::string::npos);
    EXPECT_NE(error_with("filter", "QUATERNION").find("filter 'QUATERNION'"), std::string::npos);
    EXPECT_NE(error_with("byteLength", 40).find("broken meshopt data"), std::string::npos);
    EXPECT_NE(error_with("byteOffset", 1).find("EXT_meshopt_compression"), std::string::npos);
}

} // namespace
} // namespace gnomon::scene
