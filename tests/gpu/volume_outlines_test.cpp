// SPDX-License-Identifier: Apache-2.0
// Shadow volumes as lines: as many as are counted, and where the meshes' own silhouettes lie.
#include "exact_scenes.h"

#include "shadow/parts/volume_edges.h"
#include "shadow/parts/volume_outlines.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

using glm::dvec2;
using glm::dvec3;

/// A closed body in the air, in front of nothing.
scene::Scene body()
{
    scene::Scene s;
    s.materials.emplace_back();
    for (scene::Mesh& m : closed_shape(5)) {
        // one mesh, so that every edge has both of its triangles
        if (s.meshes.empty()) {
            s.meshes.push_back(std::move(m));
            continue;
        }
        const uint32_t first = uint32_t(s.meshes[0].positions.size());
        s.meshes[0].positions.insert(s.meshes[0].positions.end(), m.positions.begin(), m.positions.end());
        for (const uint32_t i : m.indices) s.meshes[0].indices.push_back(first + i);
    }
    s.meshes[0].normals.clear();
    scene::complete(s.meshes[0]);
    s.instances.push_back({0, mat4(1)});
    return s;
}

class VolumeOutlines : public gpu::TechniqueTest {
protected:
    static constexpr int side = 160;
    static inline const scene::Camera camera{.eye = {0.5f, 1, 3.5f}, .target = {0, 0, 0}};

    struct Drawn {
        base::Picture picture;
        uint32_t quads = 0;
    };
    static Drawn draw_outlines(const scene::Scene& s, const scene::Light& light)
    {
        const scene::View view = scene::make_view(camera, {side, side}, s.bounds());
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("outlines", VK_FORMAT_R8G8B8A8_UNORM, {side, side});
        shadow::parts::VolumeCasters casters;
        std::vector<shadow::Counter> counters;
        gpu::Buffer number = device().buffer({16, 0, gpu::Memory::device, "number"});
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        shadow::Frame frame{s, view, light, scene, g, {}};
        frame.counters = &counters;
        shadow::parts::draw_volume_outlines(passes, frame, casters, {}, passes.import(out));
        passes.copy(counters.at(0).buffer, passes.import(number), 4, counters[0].offset);
        device().submit(std::move(passes));
        Drawn drawn{device().read_back(out)};
        drawn.quads = values<uint32_t>(number).front();
        return drawn;
    }

    struct Segment {
        dvec2 from, to; ///< pixels
    };
    /// Of a mesh in the world, by the twin's own reckoning in doubles: edges between a triangle that faces the light and one that does not.
    static std::vector<Segment> silhouettes(const scene::Scene& s, const scene::Light& light)
    {
        const scene::View view = scene::make_view(camera, {side, side}, s.bounds());
        const scene::Mesh& mesh = s.meshes[0];
        const auto faces = [&](uint32_t triangle) {
            dvec3 p[3];
            for (uint32_t k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.indices[3 * triangle + k]];
            const dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
            if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) return glm::dot(n, -dvec3(sun->direction)) > 0;
            return glm::dot(n, dvec3(std::get<scene::PointLight>(light.shape).position) - p[0]) > 0;
        };
        const auto pixel = [&](uint32_t vertex) {
            const glm::dvec4 h = glm::dmat4(view.clip_from_world) * glm::dvec4(dvec3(mesh.positions[vertex]), 1);
            return (dvec2(h) / h.w * 0.5 + 0.5) * double(side);
        };
        std::vector<Segment> out;
        for (const auto& edge : shadow::parts::mesh_edges(mesh.positions, mesh.indices).edges) {
            EXPECT_EQ(edge.second & VOLUME_LIST, 0u) << "the body is closed";
            if (faces(edge.first >> 1) != faces(edge.second >> 1)) out.push_back({pixel(edge.from), pixel(edge.to)});
        }
        return out;
    }

    static double distance(const Segment& s, dvec2 p)
    {
        const dvec2 d = s.to - s.from;
        const double t = std::clamp(glm::dot(p - s.from, d) / std::max(glm::dot(d, d), 1e-12), 0.0, 1.0);
        return glm::length(s.from + t * d - p);
    }
};

TEST_F(VolumeOutlines, AreTheQuadsThatAreCounted)
{
    const scene::Scene s = body();
    for (const char* text : {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/3/2,radius=0"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const Drawn drawn = draw_outlines(s, light);
        EXPECT_EQ(drawn.quads, silhouettes(s, light).size()) << text;
        EXPECT_EQ(drawn.quads, count(technique_shadow_volumes, s, camera, {side, side}, text, {{"culling", 0}})["volume_quads"]) << text;
    }
    // open borders have quads too
    const scene::Scene open = soup(3, 40);
    const char* sun = "sun,elevation=50,azimuth=20,angle=0";
    EXPECT_EQ(draw_outlines(open, scene::parse_light(sun, {}, open.bounds())).quads,
        count(technique_shadow_volumes, open, camera, {side, side}, sun, {{"culling", 0}})["volume_quads"]);
}

TEST_F(VolumeOutlines, SilhouettesLieWhereTheMeshHasThem)
{
    const scene::Scene s = body();
    for (const char* text : {"sun,elevation=50,azimuth=20,angle=0", "point,position=1/3/2,radius=0"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const std::vector<Segment> edges = silhouettes(s, light);
        const base::Picture picture = draw_outlines(s, light).picture;
        const auto yellow = [&](int x, int y) { // red outweighs blue in silhouettes alone
            const float* p = &picture.values[(size_t(y) * side + size_t(x)) * 4];
            return p[3] > 0 && p[0] > p[2];
        };
        size_t drawn = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                if (!yellow(x, y)) continue;
                ++drawn;
                double nearest = 1e9;
                for (const Segment& e : edges) nearest = std::min(nearest, distance(e, {x + 0.5, y + 0.5}));
                EXPECT_LT(nearest, 1.5) << text << " " << x << " " << y;
            }
        EXPECT_GT(drawn, edges.size());
        for (const Segment& e : edges) {
            const dvec2 middle = 0.5 * (e.from + e.to);
            EXPECT_TRUE(yellow(int(middle.x), int(middle.y))) << text << " " << middle.x << " " << middle.y;
        }
    }
}

TEST_F(VolumeOutlines, AreNothingWhereNothingCasts)
{
    scene::Scene s;
    s.materials.emplace_back();
    const Drawn drawn = draw_outlines(s, scene::parse_light("sun,elevation=50,azimuth=20", {}, s.bounds()));
    EXPECT_EQ(drawn.quads, 0u);
    EXPECT_EQ(*std::max_element(drawn.picture.values.begin(), drawn.picture.values.end()), 0.0f);
}

} // namespace
} // namespace gnomon
