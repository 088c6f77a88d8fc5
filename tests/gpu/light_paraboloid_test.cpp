// SPDX-License-Identifier: Apache-2.0
// Dual-paraboloid layers: straight edges of large triangles are arcs in them, and are drawn as such.
#include "technique_fixture.h"
#include "tests/light_map_twin.h"

#include "shadow/parts/bias.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using gpu::camera_above;
using gpu::floor_scene;

/// A horizontal square of half width 1.5 about (0.4, 1, 0.2), of so many cells a side, facing up or down.
void add_sheet(scene::Scene& s, int cells, bool down = false)
{
    scene::Mesh sheet;
    for (int z = 0; z <= cells; ++z)
        for (int x = 0; x <= cells; ++x)
            sheet.positions.push_back({3.0f * float(x) / float(cells) - 1.5f, 0, 3.0f * float(z) / float(cells) - 1.5f});
    for (int z = 0; z < cells; ++z)
        for (int x = 0; x < cells; ++x) {
            const uint32_t a = uint32_t(z * (cells + 1) + x), b = a + uint32_t(cells) + 1;
            for (const uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) sheet.indices.push_back(i);
        }
    if (down)
        for (size_t i = 0; i < sheet.indices.size(); i += 3) std::swap(sheet.indices[i], sheet.indices[i + 1]);
    scene::complete(sheet);
    s.instances.push_back({int(s.meshes.size()), glm::translate(mat4(1), vec3(0.4f, 1, 0.2f))});
    s.meshes.push_back(sheet);
}

class LightParaboloid : public gpu::TechniqueTest {
protected:
    static constexpr int side = 128;
    static constexpr const char* light = "point,position=0.2/1.6/-0.1,radius=0";
    /// One nearest texel is off by up to half of one along both axes, which takes twice the bias that suits smooth filters.
    static Values values(int bias = BIAS_SLOPE)
    {
        return {{"map_size", 512}, {"point_layout", 2}, {"pcf", 1}, {"bilinear", 0}, {"bias", bias}, {"bias_scale", 2.7}};
    }
    static std::vector<float> draw(const scene::Scene& s, const Values& v)
    {
        return TechniqueTest::draw(technique_shadow_map, s, camera_above({0.5f, 0, 0.5f}, 0.9f, 6), {side, side}, light, v);
    }
    /// Where a floor point's ray crosses the sheet's plane: its distance to the sheet's rim, inside positive.
    static float inside(float x, float z)
    {
        // the light is 0.6 m above the sheet, which is 1 m above the floor
        const vec3 eye(0.2f, 1.6f, -0.1f), p = eye + (vec3(x, 0, z) - eye) * (0.6f / 1.6f);
        return 1.5f - std::max(std::abs(p.x - 0.4f), std::abs(p.z - 0.2f));
    }
};

TEST_F(LightParaboloid, AShadowsOutlineDoesNotDependOnItsCastersTriangles)
{
    scene::Scene coarse = floor_scene(8), fine = floor_scene(8);
    add_sheet(coarse, 1), add_sheet(fine, 24);
    const std::vector<float> a = draw(coarse, values()), b = draw(fine, values());
    size_t differing = 0, dark = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const size_t i = size_t(y * side + x);
            differing += a[i] != b[i], dark += a[i] == 0.0f;
            const float in = inside(0.5f + 6 * ((float(x) + 0.5f) / (0.5f * side) - 1), 0.5f + 6 * ((float(y) + 0.5f) / (0.5f * side) - 1));
            // a texel is at most 4 / 512 wide in angle: at the sheet's corner, 2.5 m away along the sheet, some 5 cm
            if (std::abs(in) <= 0.06f) continue;
            ASSERT_EQ(a[i], in > 0 ? 0.0f : 1.0f) << x << " " << y;
        }
    EXPECT_GT(dark, 1000u);
    EXPECT_LE(differing, 4u);
}

TEST_F(LightParaboloid, ThroughItsCornersAloneThatTriangleWouldBeWrongByManyTexels)
{
    const Bounds bounds{{-8, 0, -8}, {8, 2, 8}};
    const scene::View view = scene::make_view(camera_above({0, 0, 0}, 3, 6), {64, 64}, bounds);
    const shaders::LightMap map = shadow::parts::fit_light_map({}, bounds, view, scene::parse_light(light, {}, bounds),
        {.size = 512, .fitting = {.point_layout = int(shadow::parts::PointLayout::dual_paraboloid)}});
    const auto uv = [&](vec3 p) { return tests::project_paraboloid(map, tests::select_layer(map, p), p).uv; };
    const glm::dvec2 a = uv({-1.1f, 1, -1.3f}), b = uv({1.9f, 1, -1.3f}), middle = uv({0.4f, 1, -1.3f});
    const glm::dvec2 along = glm::normalize(b - a), off = middle - a;
    EXPECT_GT(512 * std::abs(off.x * along.y - off.y * along.x), 20.0);
}

TEST_F(LightParaboloid, FacesAreCulledAsElsewhere)
{
    // the light is above: it sees the front of a sheet that faces up, which a map of back faces leaves out
    for (const bool down : {false, true}) {
        scene::Scene s = floor_scene(8);
        add_sheet(s, 1, down);
        const auto dark = [&](int bias) {
            const std::vector<float> v = draw(s, values(bias));
            return size_t(std::count(v.begin(), v.end(), 0.0f));
        };
        EXPECT_GT(dark(BIAS_SLOPE), 1000u);
        if (down)
            EXPECT_GT(dark(BIAS_SECOND_DEPTH), 1000u);
        else
            EXPECT_LT(dark(BIAS_SECOND_DEPTH), 20u);
    }
}

TEST_F(LightParaboloid, TrianglesAllAroundTheLightAreDrawn)
{
    // one triangle straight behind each paraboloid's axis, through its rim and across both: a tube of four walls about the light
    scene::Scene s;
    s.materials.emplace_back();
    s.materials[0].double_sided = true;
    for (int wall = 0; wall < 4; ++wall) {
        scene::Mesh m;
        m.positions = {{1, -4, -1.001f}, {1, -4, 1.001f}, {1, 4, 1.001f}, {1, 4, -1.001f}};
        m.indices = {0, 1, 2, 0, 2, 3};
        scene::complete(m);
        s.instances.push_back({int(s.meshes.size()), glm::rotate(mat4(1), float(wall) * 0.5f * pi, vec3(0, 1, 0))});
        s.meshes.push_back(m);
    }
    // boards outside of the tube: all in its shadow
    for (int wall = 0; wall < 4; ++wall) {
        scene::Mesh m;
        m.positions = {{1.2f, -3, -0.9f}, {1.2f, -3, 0.9f}, {1.2f, 3, 0.9f}, {1.2f, 3, -0.9f}};
        m.indices = {0, 1, 2, 0, 2, 3};
        scene::complete(m);
        s.instances.push_back({int(s.meshes.size()), glm::rotate(mat4(1), float(wall) * 0.5f * pi, vec3(0, 1, 0))});
        s.meshes.push_back(m);
    }
    const auto seen = [&](bool from_inside) {
        double sum = 0;
        for (int wall = 0; wall < 4; ++wall) {
            const float turn = float(wall) * 0.5f * pi;
            // the board's inner side is seen from between it and the wall, the wall's from the light
            const vec3 out(std::cos(turn), 0, -std::sin(turn));
            const scene::Camera camera{
                .eye = from_inside ? vec3(0) : out * 1.1f, .target = out * 2.0f, .up = {0, 1, 0}, .half_height = 0.8f};
            sum += mean(TechniqueTest::draw(technique_shadow_map, s, camera, {32, 32}, "point,position=0/0/0,radius=0", values()));
        }
        return sum / 4;
    };
    EXPECT_EQ(seen(true), 1.0);
    EXPECT_EQ(seen(false), 0.0);
}

} // namespace
} // namespace gnomon
