// SPDX-License-Identifier: Apache-2.0
// Planar shadows on scenes of a few quads: what casts nothing, what is darkened once, and lights that a plane holds.
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_planar;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;
using gpu::half_shadowed;

class Planar : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, const char* light, const Values& values = {})
    {
        return TechniqueTest::draw(technique_planar, s, camera, {64, 64}, light, values);
    }
    static size_t dark(const std::vector<float>& v)
    {
        return size_t(std::count_if(v.begin(), v.end(), [](float x) { return x < 1.0f; }));
    }
    /// Only the floor, which is largest, receives.
    static inline const Values floor_only{{"planes", 1}};
};

/// Between near and far of the camera nothing but the floor is seen: it stands just above it.
scene::Camera low_camera() { return camera_above({0, 0, 0}, 0.1f, 4); }

TEST_F(Planar, ShadowLiesWhereTheRaysSayUnderAllLights)
{
    scene::Scene s = floor_scene(8);
    add_quad(s, {1, 1, 0.5f}, 0.5f);
    // sun at 45 degrees from +x: the shadow moves by one metre to -x; a light three metres above the origin magnifies by 3/2
    const struct {
        const char* light;
        float x0, x1, z0, z1;
    } cases[] = {{"sun,elevation=45,azimuth=90,angle=0", -0.5f, 0.5f, 0, 1}, {"point,position=0/3/0,radius=0", 0.75f, 2.25f, 0, 1.5f},
        {"spot,position=0/3/0,target=0.5/0/0.5,cone=150,radius=0", 0.75f, 2.25f, 0, 1.5f}};
    for (const auto& c : cases) {
        const std::vector<float> v = draw(s, low_camera(), c.light, floor_only);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const float px = (float(x) + 0.5f) / 8 - 4, pz = (float(y) + 0.5f) / 8 - 4;
                const bool inside = px > c.x0 && px < c.x1 && pz > c.z0 && pz < c.z1;
                ASSERT_EQ(v[size_t(y * 64 + x)], inside ? 0.0f : 1.0f) << c.light << " at " << px << " " << pz;
            }
    }
}

TEST_F(Planar, ThingsPastTheLightOrBelowTheFloorCastNothing)
{
    for (const char* light : {"point,position=0/2/0,radius=0", "spot,position=0/2/0,target=0/0/0,cone=170,radius=0"}) {
        scene::Scene s = floor_scene(8);
        add_quad(s, {1, 2.5f, 0}, 0.4f); // anti-shadow: its projection lands on the other side of the light
        add_quad(s, {1, -1, 0}, 0.6f);
        const size_t lit = dark(draw(floor_scene(8), low_camera(), light, floor_only));
        EXPECT_EQ(dark(draw(s, low_camera(), light, floor_only)), lit) << light;
        add_quad(s, {1, 0.5f, 0}, 0.4f);
        EXPECT_GT(dark(draw(s, low_camera(), light, floor_only)), lit + 20) << light;
    }
    scene::Scene s = floor_scene(8);
    add_quad(s, {1, -1, 0}, 0.6f);
    EXPECT_EQ(dark(draw(s, low_camera(), "sun,elevation=50,angle=0", floor_only)), 0u);
}

TEST_F(Planar, TrianglesThroughTheLightsHeightAndTheFloorAreCut)
{
    // an upright sheet at x = 1, from below the floor to above the light: it shadows all that lies behind it, and nothing else
    scene::Scene s = floor_scene(20);
    scene::Mesh sheet;
    sheet.positions = {{1, -2, -1}, {1, -2, 1}, {1, 7, 1}, {1, 7, -1}};
    sheet.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(sheet);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(sheet);
    const std::vector<float> v = draw(s, low_camera(), "point,position=0/2/0,radius=0", floor_only);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const float px = (float(x) + 0.5f) / 8 - 4, pz = (float(y) + 0.5f) / 8 - 4;
            if (std::abs(std::abs(pz) - px) < 0.01f) continue; // an edge runs through the pixel's centre
            ASSERT_EQ(v[size_t(y * 64 + x)], px > 1 && std::abs(pz) < px ? 0.0f : 1.0f) << px << " " << pz;
        }
}

TEST_F(Planar, LayersOfCastersDarkenOnce)
{
    scene::Scene s = half_shadowed();
    for (int i = 0; i < 4; ++i) add_quad(s, {-2, 1.2f + 0.2f * float(i), 0}, 1.5f);
    const auto least = [&](double once) {
        const std::vector<float> v = draw(s, low_camera(), "sun,elevation=90,angle=0", {{"planes", 1}, {"darkness", 0.5}, {"once", once}});
        size_t half = 0;
        for (const float x : v) half += x == 0.5f;
        EXPECT_GT(half, 400u); // around the four upper layers
        return *std::min_element(v.begin(), v.end());
    };
    EXPECT_EQ(least(1), 0.5f);
    EXPECT_EQ(least(0), 0.03125f); // five layers: the fault that the stencil is for
}

TEST_F(Planar, SurfacesOffThePlanesAreLit)
{
    // a rough ground under a sheet: no plane to receive
    scene::Scene s;
    s.materials.emplace_back();
    s.materials[0].double_sided = true;
    scene::Mesh ground;
    constexpr int n = 24;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            ground.positions.push_back({float(x) / 3 - 4, 0.02f * float((7 * x * x + 5 * y * y + 3 * x * y) % 11), float(y) / 3 - 4});
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const uint32_t a = uint32_t(y * (n + 1) + x), b = a + n + 1;
            for (const uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) ground.indices.push_back(i);
        }
    scene::complete(ground);
    s.instances.push_back({0, mat4(1)});
    s.meshes.push_back(ground);
    add_quad(s, {-2, 50, 0}, 2);
    const scene::Camera camera = camera_above({0, 0, 0}, 40, 3.5f);
    EXPECT_EQ(dark(draw(s, camera, "sun,elevation=90,angle=0", {{"smallest_plane", 0.5}})), 0u);
    // and with the sheet as a plane, nothing is above it
    EXPECT_EQ(dark(draw(s, camera, "sun,elevation=90,angle=0", {{"smallest_plane", 0.05}})), 0u);
}

TEST_F(Planar, APlaneThatHoldsTheLightIsDark)
{
    const scene::Scene s = half_shadowed();
    EXPECT_EQ(dark(draw(s, low_camera(), "point,position=1/0/1,radius=0", floor_only)), 64u * 64u);
    EXPECT_EQ(dark(draw(s, low_camera(), "sun,elevation=0,azimuth=30,angle=0", floor_only)), 64u * 64u);
    // from below, the floor's upper side gets nothing either
    EXPECT_EQ(dark(draw(s, low_camera(), "point,position=1/-2/1,radius=0", floor_only)), 64u * 64u);
}

TEST_F(Planar, FloorsOnEitherSideOfTheLightReceive)
{
    // floor and ceiling with a light and a sheet between: the sheet above the light shadows the ceiling only, its own plane too if asked
    // for
    scene::Scene s = floor_scene(8);
    add_quad(s, {0, 4, 0}, 8);
    add_quad(s, {1, 3, 0}, 0.5f);
    const scene::Camera up{.eye = {0, 3.8f, 0}, .target = {0, 10, 0}, .up = {0, 0, -1}, .half_height = 4};
    const char* light = "point,position=0/2/0,radius=0";
    EXPECT_EQ(dark(draw(s, low_camera(), light, {{"planes", 2}})), 0u);
    // one metre wide, half-way: two metres across, 16 x 16 pixels
    EXPECT_EQ(dark(draw(s, up, light, {{"planes", 2}})), 256u);
    EXPECT_EQ(dark(draw(s, up, light, {{"planes", 1}})) + dark(draw(s, low_camera(), light, {{"planes", 1}})) <= 256u, true);
}

} // namespace
} // namespace gnomon
