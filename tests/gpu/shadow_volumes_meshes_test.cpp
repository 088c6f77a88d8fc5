// SPDX-License-Identifier: Apache-2.0
// Shadow volumes of meshes that are no surfaces, and where fewer edges fail.
#include "exact_suite.h"

extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

constexpr double closed = 0, bergeron = 1, any = 2;
constexpr double zpass = 0, zfail = 1, zp_plus = 2, pp_zp = 3;
const char* const sun = "sun,elevation=50,azimuth=20,angle=0";
const char* const lamp = "point,position=1/3.5/1,radius=0";

class ShadowVolumesOfMeshes : public ExactTest {
protected:
    static ExactSubject with(std::vector<std::pair<const char*, double>> values)
    {
        return {technique_shadow_volumes, "volumes", std::move(values)};
    }
};

/// A strip of quads that is joined to itself after half a turn, so that it has one side.
scene::Mesh moebius_strip()
{
    scene::Mesh m;
    constexpr uint32_t n = 36;
    for (uint32_t i = 0; i < n; ++i) {
        const float around = 2 * pi * float(i) / float(n), twist = 0.5f * around;
        const vec3 out(std::cos(around), 0, std::sin(around));
        const vec3 across = 0.5f * (std::cos(twist) * out + std::sin(twist) * vec3(0, 1, 0));
        m.positions.push_back(1.5f * out + across), m.positions.push_back(1.5f * out - across);
    }
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t a = 2 * i, b = a + 1, last = i + 1 == n, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        m.indices.insert(m.indices.end(), {a, b, c, c, b, d});
    }
    return m;
}

/// A bottle without inside, whose neck passes through its wall.
scene::Mesh klein_bottle()
{
    scene::Mesh m;
    constexpr uint32_t n = 24, k = 12;
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < k; ++j) { // the figure-8 immersion
            const float u = 2 * pi * float(i) / float(n), v = 2 * pi * float(j) / float(k);
            const float r = 1.2f + 0.7f * (std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v));
            m.positions.push_back(
                {r * std::cos(u), 0.7f * (std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)), r * std::sin(u)});
        }
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < k; ++j) {
            const auto at = [&](uint32_t a, uint32_t b) { return a == n ? (k - b % k) % k : a * k + b % k; };
            m.indices.insert(m.indices.end(), {at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return m;
}

/// Pages at one spine, wound by turns.
scene::Mesh book(uint32_t pages)
{
    scene::Mesh m;
    m.positions = {{-1.2f, 0, 0.1f}, {1.2f, 0.2f, -0.1f}};
    for (uint32_t p = 0; p < pages; ++p) {
        const float angle = 0.3f + 2.9f * float(p) / float(pages);
        const auto v = uint32_t(m.positions.size());
        for (const float x : {-1.2f, 1.2f}) m.positions.push_back({x, 1.3f * std::sin(angle), 1.3f * std::cos(angle)});
        if (p % 2)
            m.indices.insert(m.indices.end(), {0, 1, v, v, 1, v + 1});
        else
            m.indices.insert(m.indices.end(), {1, 0, v, 1, v, v + 1});
    }
    return m;
}

/// A sheet with fins that end on the middle of its edges: corners where no other triangle has one.
scene::Mesh fins()
{
    scene::Mesh m;
    m.positions = {{-1.5f, 0, -1.5f}, {1.5f, 0.2f, -1.5f}, {1.5f, 0, 1.5f}, {-1.5f, 0.2f, 1.5f}, {0, 0, 0}, {0, 1.2f, 0},
        {0.9f, 0.06f, 0.9f}, {-0.7f, 0.8f, -0.7f}};
    m.indices = {0, 2, 1, 0, 3, 2, 0, 2, 5, 4, 6, 5, 4, 5, 7};
    return m;
}

scene::Scene over_floor(const scene::Mesh& m)
{
    scene::Scene s = floor_scene(4);
    add_mesh(s, m, glm::translate(glm::rotate(mat4(1), 0.3f, vec3(0.4f, 1, 0.2f)), vec3(0, 1.6f, 0)));
    return s;
}

TEST_F(ShadowVolumesOfMeshes, MeshesThatAreNoSurfacesCastByAnyEdges)
{
    const std::pair<const char*, scene::Mesh> meshes[]
        = {{"strip", moebius_strip()}, {"bottle", klein_bottle()}, {"seven pages", book(7)}, {"two pages", book(2)}, {"fins", fins()}};
    for (const auto& [name, mesh] : meshes)
        for (const char* light : {sun, lamp})
            for (const double count : {zfail, pp_zp, zp_plus}) {
                SCOPED_TRACE(fmt::format("{}, count {}", name, count));
                expect_right(with({{"edges", any}, {"count", count}}), over_floor(mesh), oblique, {128, 96}, light, 100, 100, 0.12);
            }
}

TEST_F(ShadowVolumesOfMeshes, FewerEdgesFailOnMeshesThatTheyDoNotKnow)
{
    scene::Scene sheet = floor_scene(4);
    gpu::add_quad(sheet, {0, 2, 0}, 1);
    const scene::Scene seven = over_floor(book(7)), strip = over_floor(moebius_strip());
    const auto wrong = [](const scene::Scene& s, double edges) {
        return compare(with({{"edges", edges}}), s, oblique, {128, 96}, lamp).wrong;
    };
    EXPECT_GT(wrong(sheet, closed), 200u);
    EXPECT_EQ(wrong(sheet, bergeron), 0u);
    EXPECT_GT(wrong(seven, closed), 200u);
    EXPECT_GT(wrong(seven, bergeron), 200u) << "quads at the spine are missing";
    EXPECT_GT(wrong(strip, bergeron), 20u) << "winding cannot be consistent";
    EXPECT_EQ(wrong(seven, any) + wrong(strip, any) + wrong(sheet, any), 0u);
}

TEST_F(ShadowVolumesOfMeshes, ClosedMeshesNeedNoMoreThanTheirSilhouettes)
{
    for (uint32_t seed = 1; seed < 4; ++seed) {
        // one mesh, although its triangles share positions alone; the floor, which is open, is a slab
        scene::Mesh whole;
        for (const scene::Mesh& half : closed_shape(seed))
            for (const uint32_t i : half.indices) {
                whole.indices.push_back(uint32_t(whole.positions.size()));
                whole.positions.push_back(half.positions[i]);
            }
        scene::Scene s;
        s.materials.emplace_back();
        s.materials[0].double_sided = seed % 2;
        add_mesh(s, box(), glm::scale(mat4(1), {4, 0.2f, 4}));
        add_mesh(s, whole, glm::translate(mat4(1), {0, 1.9f, 0}));
        add_mesh(s, box(), glm::scale(glm::translate(mat4(1), {2, 1, 0.3f}), {0.3f, 0.5f, 0.6f}));
        for (const char* light : {sun, lamp, "spot,position=5/6/2,target=0/0/0,cone=50,radius=0"})
            for (const double count : {zpass, zfail, zp_plus, pp_zp}) {
                SCOPED_TRACE(fmt::format("{}, count {}", light, count));
                const std::vector<float> all = draw(with({{"count", count}}), s, oblique, {128, 96}, light);
                const Count c = compare(all, s, oblique, {128, 96}, light);
                EXPECT_EQ(c.wrong, 0u);
                EXPECT_GT(c.dark, 150u);
                EXPECT_EQ(all, draw(with({{"count", count}, {"edges", closed}}), s, oblique, {128, 96}, light));
                EXPECT_EQ(all, draw(with({{"count", count}, {"edges", bergeron}}), s, oblique, {128, 96}, light));
            }
    }
}

} // namespace
} // namespace gnomon
