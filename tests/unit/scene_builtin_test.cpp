// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/hash.h"
#include "scene/generators/analytic_scenes.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace gnomon::scene {
namespace {

std::string content_hash(const Scene& scene)
{
    base::Hasher h;
    for (const Texture& t : scene.textures) h.text(t.name).value(t.width).value(t.height).array(t.rgba);
    for (const Material& m : scene.materials) h.text(m.name).value(m.base_color).value(m.base_color_texture.texture).value(m.roughness);
    for (const Mesh& m : scene.meshes)
        h.text(m.name).value(m.material).array(m.positions).array(m.normals).array(m.uvs).array(m.colors).array(m.indices);
    for (const Instance& i : scene.instances) h.value(i.mesh).value(i.world_from_object);
    for (const Camera& c : scene.cameras) h.text(c.name).value(c.eye).value(c.target).value(c.fov_y);
    for (const Light& l : scene.lights) h.text(l.name).value(l.color).value(l.kind()).value(light_point(l, vec3(1, 2, 3), vec2(0.3f)));
    return h.hex();
}

bool finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Every edge is walked as often one way as the other: closed, and wound consistently.
bool watertight(const Mesh& mesh)
{
    using Point = std::tuple<float, float, float>;
    const auto point = [&](uint32_t i) { return Point(mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z); };
    std::map<std::pair<Point, Point>, int> balance;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        for (size_t k = 0; k < 3; ++k) {
            const Point a = point(mesh.indices[t + k]), b = point(mesh.indices[t + (k + 1) % 3]);
            ++balance[{a, b}], --balance[{b, a}];
        }
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

void expect_sound(const Scene& scene)
{
    ASSERT_FALSE(scene.instances.empty());
    for (const Mesh& m : scene.meshes) {
        SCOPED_TRACE(m.name);
        ASSERT_GE(m.material, 0);
        ASSERT_LT(size_t(m.material), scene.materials.size());
        ASSERT_EQ(m.normals.size(), m.positions.size());
        ASSERT_TRUE(m.uvs.empty() || m.uvs.size() == m.positions.size());
        ASSERT_TRUE(m.colors.empty() || m.colors.size() == m.positions.size());
        ASSERT_GT(m.indices.size(), 0u);
        ASSERT_EQ(m.indices.size() % 3, 0u);
        ASSERT_LT(*std::max_element(m.indices.begin(), m.indices.end()), m.positions.size());
        EXPECT_TRUE(std::all_of(m.positions.begin(), m.positions.end(), finite));
        EXPECT_TRUE(std::all_of(m.normals.begin(), m.normals.end(), [](vec3 n) { return std::abs(glm::length(n) - 1.0f) < 1e-4f; }));
        EXPECT_TRUE(std::all_of(m.uvs.begin(), m.uvs.end(), [](vec2 uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }));
        EXPECT_FALSE(m.bounds.empty());
    }
    for (const Material& m : scene.materials) ASSERT_LT(m.base_color_texture.texture, int(scene.textures.size()));
    for (const Texture& t : scene.textures) {
        EXPECT_LE(t.width, 256);
        EXPECT_EQ(t.rgba.size(), size_t(t.width) * size_t(t.height) * 4);
    }
    for (const Instance& i : scene.instances) {
        ASSERT_LT(size_t(i.mesh), scene.meshes.size());
        EXPECT_GT(glm::determinant(mat3(i.world_from_object)), 0.0f);
    }
}

class SceneBuiltin : public testing::TestWithParam<Builtin> { };

TEST_P(SceneBuiltin, IsSound)
{
    const Scene scene = load(std::string(GetParam().name));
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_TRUE(scene.warnings.empty());
    expect_sound(scene);
}

TEST_P(SceneBuiltin, IsTheSameEachTime) { EXPECT_EQ(content_hash(GetParam().make(1.0)), content_hash(GetParam().make(1.0))); }

TEST_P(SceneBuiltin, HasCamerasAndLightsWithNamesOfTheirOwn)
{
    const Scene scene = GetParam().make(1.0);
    std::set<std::string> cameras, lights;
    for (const Camera& c : scene.cameras) cameras.insert(c.name);
    for (const Light& l : scene.lights) lights.insert(l.name);
    EXPECT_EQ(cameras.size(), scene.cameras.size());
    EXPECT_EQ(lights.size(), scene.lights.size());
    ASSERT_GE(scene.cameras.size(), 1u);
    ASSERT_GE(scene.lights.size(), 2u);
    EXPECT_TRUE(scene.lights[0].name == "sun" || scene.lights[0].name == "main");
    EXPECT_TRUE(lights.count("sun") && lights.count("soft sun"));
    const Bounds bounds = scene.bounds();
    for (const Camera& c : scene.cameras) EXPECT_NO_THROW(make_view(c, {64, 36}, bounds));
}

TEST_P(SceneBuiltin, TellsItsMaterialsTruly)
{
    const Scene scene = GetParam().make(1.0);
    const bool opaque
        = std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return m.alpha == AlphaMode::opaque; });
    EXPECT_EQ(opaque, GetParam().opaque);
}

TEST_P(SceneBuiltin, DetailMultipliesTriangles)
{
    const Scene plain = GetParam().make(1.0), fine = GetParam().make(4.0);
    EXPECT_GE(fine.triangle_count(), 3 * plain.triangle_count());
    EXPECT_LE(fine.triangle_count(), 6 * plain.triangle_count());
    expect_sound(fine);
    EXPECT_LE(GetParam().make(0.25).triangle_count(), plain.triangle_count());
}

TEST_P(SceneBuiltin, SolidsAreClosed)
{
    // Meshes with a single-sided material are solids, save the grounds.
    const std::set<std::string> grounds = {"floor", "ground", "paving", "grass", "land", "asphalt", "court lines"};
    for (double detail : {1.0, 4.0}) {
        const Scene scene = GetParam().make(detail);
        for (const Mesh& m : scene.meshes) {
            if (scene.materials[size_t(m.material)].double_sided || grounds.count(m.name)) continue;
            EXPECT_TRUE(watertight(m)) << m.name << " at detail " << detail;
        }
    }
}

TEST_P(SceneBuiltin, TriangleCountIsThatOfTheManual)
{
    const std::map<std::string, size_t> stated = {{"plane", 2}, {"tilted_planes", 38}, {"closed_box", 1000}, {"half_plane", 4},
        {"rect_blocker", 4}, {"disk_blocker", 258}, {"stacked_panes", 800}, {"balls", 61000}, {"contact", 5000}, {"open_mesh", 2500},
        {"colonnade", 53000}, {"duelling_frusta", 40000}, {"fence", 26000}, {"tree", 35000}, {"terrain", 68000}, {"citadel", 68000},
        {"stacked", 650}, {"grazing", 2600}};
    const auto entry = stated.find(std::string(GetParam().name));
    ASSERT_NE(entry, stated.end());
    EXPECT_NEAR(double(GetParam().make(1.0).triangle_count()), double(entry->second), 0.05 * double(entry->second));
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneBuiltin, testing::ValuesIn(builtins()), [](const auto& instance) { return std::string(instance.param.name); });

TEST(SceneBuiltins, ClosedBoxEnclosesItsCameras)
{
    const Scene scene = load("closed_box");
    for (const Camera& c : scene.cameras) {
        EXPECT_TRUE(glm::all(glm::greaterThan(c.eye, vec3(-3, 0, -2.5f))) && glm::all(glm::lessThan(c.eye, vec3(3, 3, 2.5f)))) << c.name;
    }
    for (const Light& l : scene.lights) {
        const vec4 p = light_point(l, vec3(0), vec2(0.5f));
        EXPECT_TRUE(p.w == 0.0f || p.y > 3.3f) << l.name;
    }
}

TEST(SceneBuiltins, BlockersAreWhereTheClosedFormsHaveThem)
{
    using namespace analytic_scenes;
    const auto bounds_of = [](const char* scene_name, const char* mesh_name) {
        const Scene scene = load(scene_name);
        for (const Mesh& m : scene.meshes)
            if (m.name == mesh_name) return m.bounds;
        return Bounds{};
    };
    EXPECT_EQ(bounds_of("half_plane", "half-plane").max, vec3(half_plane_edge_x, half_plane_y, half_plane_reach));
    EXPECT_EQ(bounds_of("rect_blocker", "rectangle").min, vec3(rect_blocker_min.x, rect_blocker_y, rect_blocker_min.y));
    EXPECT_EQ(bounds_of("rect_blocker", "rectangle").max, vec3(rect_blocker_max.x, rect_blocker_y, rect_blocker_max.y));
    const Bounds disk = bounds_of("disk_blocker", "disk");
    EXPECT_NEAR(disk.max.x - disk.min.x, 2 * disk_blocker_radius, 1e-4f);
    EXPECT_EQ(disk.min.y, disk_blocker_y);
}

TEST(SceneBuiltins, LoadRefusesWhatItDoesNotKnow)
{
    const auto message = [](const std::string& name, const LoadOptions& options = {}) -> std::string {
        try {
            load(name, options);
        } catch (const base::Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message("citadell").find("'citadel'"), std::string::npos) << message("citadell");
    EXPECT_NE(message("").find("scene"), std::string::npos);
    EXPECT_NE(message("no-such-file.json").find("no-such-file.json"), std::string::npos);
    EXPECT_NE(message("plane", {.detail = 0.0}).find("0.05 to 256"), std::string::npos);
    EXPECT_NE(message("plane", {.detail = NAN}).find("0.05 to 256"), std::string::npos);
    EXPECT_NE(message("plane", {.detail = 1e9}).find("0.05 to 256"), std::string::npos);
    EXPECT_NE(message("plane", {.time = INFINITY}).find("finite"), std::string::npos);
}

} // namespace
} // namespace gnomon::scene
