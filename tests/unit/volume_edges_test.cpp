// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_edges.h"
#include "shadow/parts/volumes.h"

#include <gtest/gtest.h>

#include <array>

namespace gnomon {
namespace {

using shadow::parts::mesh_edges;
using shadow::parts::MeshEdges;

/// The triangles beside an edge, as the edge names them.
std::vector<uint32_t> beside(const MeshEdges& m, const shaders::VolumeEdge& e)
{
    if (e.second == VOLUME_ALONE) return {e.first};
    if ((e.second & VOLUME_LIST) == 0) return {e.first, e.second};
    const auto begin = m.list.begin() + e.first;
    return {begin, begin + (e.second & ~VOLUME_LIST)};
}

TEST(VolumeEdges, VerticesAtOnePositionAreOne)
{
    // a box whose triangles share nothing but positions, some of which are -0
    const std::array<uint32_t, 36> box{
        0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    std::vector<vec3> positions;
    std::vector<uint32_t> indices;
    for (const uint32_t corner : box) {
        const float zero = positions.size() % 2 ? 0.0f : -0.0f;
        indices.push_back(uint32_t(positions.size()));
        positions.push_back({corner & 1 ? 1 : zero, corner & 2 ? 1 : zero, corner & 4 ? 1 : zero});
    }
    const MeshEdges m = mesh_edges(positions, indices);
    EXPECT_EQ(m.edges.size(), 18u);
    EXPECT_TRUE(m.list.empty());
    for (const shaders::VolumeEdge& e : m.edges) {
        const std::vector<uint32_t> sides = beside(m, e);
        ASSERT_EQ(sides.size(), 2u);
        EXPECT_NE(sides[0] & 1, sides[1] & 1) << "neighbours run through their edge in opposite ways";
    }
}

TEST(VolumeEdges, AnyNumberOfTrianglesMeetAtAnEdge)
{
    std::vector<vec3> positions{{0, 0, 0}, {0, 1, 0}};
    std::vector<uint32_t> indices;
    for (uint32_t k = 0; k < 7; ++k) {
        positions.push_back({float(k), 0, 1});
        indices.insert(indices.end(), {k % 2, 1 - k % 2, 2 + k});
    }
    const MeshEdges m = mesh_edges(positions, indices);
    EXPECT_EQ(m.edges.size(), 15u);
    size_t spines = 0;
    for (const shaders::VolumeEdge& e : m.edges) {
        const std::vector<uint32_t> sides = beside(m, e);
        if (sides.size() == 1) continue;
        ++spines;
        ASSERT_EQ(sides.size(), 7u);
        for (uint32_t k = 0; k < 7; ++k) EXPECT_EQ(sides[k], 2 * k + k % 2);
    }
    EXPECT_EQ(spines, 1u);
}

TEST(VolumeEdges, TrianglesWithoutThreeCornersAreLeftOut)
{
    const std::vector<vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    EXPECT_EQ(mesh_edges(positions, std::vector<uint32_t>{0, 1, 3, 1, 1, 2}).edges.size(), 0u);
    EXPECT_EQ(mesh_edges(positions, std::vector<uint32_t>{0, 1, 2, 1, 3, 2}).edges.size(), 3u);
    EXPECT_EQ(mesh_edges({}, {}).edges.size(), 0u);
}

TEST(VolumeScissor, HoldsEveryPixelThatASpotReaches)
{
    const Bounds bounds{vec3(-4, 0, -4), vec3(4, 3, 4)};
    const scene::View view = scene::make_view({.eye = {4, 4, 6}, .target = {0, 0.5f, 0}}, {96, 64}, bounds);
    size_t smaller = 0;
    for (const char* text : {"spot,position=1/3/0,target=0/0/0,cone=20", "spot,position=5/6/2,target=0/0/0,cone=50",
             "spot,position=4/4/6.5,target=0/0.5/0,cone=10", "spot,position=0/3/0,target=4/4/6,cone=30",
             "spot,position=0/1/20,target=0/1/30,cone=10", "spot,position=0/2/0,target=0/2/1,cone=170",
             "spot,position=3.9/3.9/5.8,target=9/3/5,cone=90"}) {
        const scene::Light light = scene::parse_light(text, {}, bounds);
        const shadow::parts::PixelRectangle r = shadow::parts::lit_rectangle(view, light, bounds);
        smaller += r.width * r.height < 96 * 64 / 2;
        const auto& spot = std::get<scene::SpotLight>(light.shape);
        for (float x = -4; x <= 4; x += 0.25f)
            for (float y = 0; y <= 3; y += 0.25f)
                for (float z = -4; z <= 4; z += 0.25f) {
                    const vec3 p(x, y, z);
                    if (glm::dot(glm::normalize(p - spot.position), spot.direction) < std::cos(spot.outer_angle)) continue;
                    const vec4 clip = view.clip_from_world * vec4(p, 1);
                    if (clip.w <= 0 || clip.z > clip.w || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
                    const vec2 at = (vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(96, 64);
                    ASSERT_TRUE(at.x >= float(r.x) && at.y >= float(r.y) && at.x <= float(r.x) + float(r.width)
                        && at.y <= float(r.y) + float(r.height))
                        << text << " reaches " << x << " " << y << " " << z;
                }
    }
    EXPECT_GE(smaller, 3u);
}

} // namespace
} // namespace gnomon
