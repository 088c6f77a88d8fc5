// SPDX-License-Identifier: Apache-2.0
// Warped light maps drawn and looked up, on scenes of a few quads: no acne, no false shadows of what lies behind the warp, no lost casters.
#include "technique_fixture.h"

#include "shaders/bias.shared.h"

#include "shadow/parts/light_map.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::floor_scene;
using shadow::parts::Fit;

constexpr Fit warps[] = {Fit::psm, Fit::lispsm, Fit::tsm, Fit::cascades_warped};
constexpr gpu::Size picture{96, 64};

class WarpedMap : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(const scene::Scene& s, const scene::Camera& camera, const char* light, Fit fit, double size,
        double slope = 1.0, double bias = BIAS_SLOPE)
    {
        return TechniqueTest::draw(technique_shadow_map, s, camera, picture, light,
            {{"fit", double(fit)}, {"map_size", size}, {"bias", bias}, {"bias_scale", slope}, {"stable_cascades", 0}});
    }

    /// Pixels that are lit where a fine map without a warp has shadow, or the other way round.
    static double wrong(const scene::Scene& s, const scene::Camera& camera, const char* light, Fit fit)
    {
        const std::vector<float> got = draw(s, camera, light, fit, 1024), fine = draw(s, camera, light, Fit::focused, 4096);
        size_t count = 0;
        for (size_t i = 0; i < got.size(); ++i) count += std::abs(got[i] - fine[i]) > 0.6f;
        return double(count) / double(got.size());
    }
};

/// A standing wall through `a` and `b`, from `low` to `high`.
void add_wall(scene::Scene& s, vec3 a, vec3 b, float low, float high)
{
    scene::Mesh wall;
    wall.positions = {{a.x, low, a.z}, {b.x, low, b.z}, {b.x, high, b.z}, {a.x, high, a.z}};
    wall.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(wall);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(wall);
}

const scene::Camera along_the_floor{.eye = {0, 2, 18}, .target = {0, 0, 0}};

// Taps reach two texels in u and in v: polygon offset by the slope times twice that radius holds off self-shadowing in any direction of the
// slope. By itself it takes three quarters of that.
TEST_F(WarpedMap, TiltedPlanesDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(20);
    for (const char* light : {"sun,elevation=90,angle=0", "sun,elevation=45,azimuth=20,angle=0", "sun,elevation=20,azimuth=70,angle=0",
             "sun,elevation=12,azimuth=200,angle=0", "sun,elevation=10,azimuth=90,angle=0",
             "spot,position=14/9/3,target=0/0/2,cone=100,radius=0"})
        for (const Fit fit : warps) {
            for (const int bias : {BIAS_SLOPE, BIAS_CONE, BIAS_RECEIVER_PLANE, BIAS_TEXEL_WORLD}) {
                const std::vector<float> got = draw(s, along_the_floor, light, fit, 512, bias == BIAS_SLOPE ? 1.34 : 1.0, double(bias));
                size_t partly = 0;
                for (const float v : got) partly += v > 1e-5f && v < 1.0f - 1e-5f; // outside of a spot's cone it is dark
                EXPECT_EQ(partly, 0u) << light << ", fit " << int(fit) << ", bias " << bias;
            }
        }
    // what holds it off is the bias that fragments emulate
    const std::vector<float> bare = draw(s, along_the_floor, "sun,elevation=20,azimuth=70,angle=0", Fit::lispsm, 512, 0.0);
    EXPECT_LT(mean(bare), 0.9);
}

TEST_F(WarpedMap, CastersBehindTheEyeAndFarAboveCastTheirShadows)
{
    scene::Scene s = floor_scene(20);
    add_quad(s, {0, 6, 26}, 5); // behind the eye
    add_quad(s, {300, 400, 0}, 6); // hundreds of metres towards the sun
    add_wall(s, {4, 0, -60}, {4, 0, 60}, 0, 3); // beside the eye, from before it to behind
    add_wall(s, {-60, 0, 40}, {60, 0, 40}, 0, 30); // across, behind
    int shadowed = 0;
    for (const char* light :
        {"sun,elevation=53.1301,azimuth=90,angle=0", "sun,elevation=35,azimuth=180,angle=0", "sun,elevation=25,azimuth=20,angle=0",
            "sun,elevation=35,azimuth=0,angle=0", "sun,elevation=90,angle=0", "spot,position=8/7/24,target=0/0/4,cone=110,radius=0"}) {
        const std::vector<float> fine = draw(s, along_the_floor, light, Fit::focused, 4096);
        shadowed += mean(fine) < 0.95;
        for (const Fit fit : warps) EXPECT_LT(wrong(s, along_the_floor, light, fit), 0.03) << light << ", fit " << int(fit);
    }
    EXPECT_GE(shadowed, 4);
}

TEST_F(WarpedMap, OddScenesAndLightsAreDrawn)
{
    scene::Scene huge = floor_scene(1);
    huge.meshes[0].positions = {{-1e4f, 0, -1e4f}, {0, 0, 2e4f}, {1e4f, 0, -1e4f}};
    huge.meshes[0].indices = {0, 1, 2};
    huge.meshes[0].normals.clear(), huge.meshes[0].uvs.clear();
    scene::complete(huge.meshes[0]);
    scene::Scene room = floor_scene(20);
    add_quad(room, {0, 6, 0}, 3);
    const scene::Camera away{.eye = {0, 2, 18}, .target = {0, 12, 40}}, down{.eye = {0, 15, 0.01f}, .target = {0, 0, 0}};
    for (const Fit fit : warps) {
        SCOPED_TRACE(int(fit));
        for (const float v : draw(huge, along_the_floor, "sun,elevation=40,azimuth=60,angle=0", fit, 512, 1.34)) ASSERT_GT(v, 1.0f - 1e-5f);
        // nothing in view
        for (const float v : draw(room, away, "sun,elevation=40,azimuth=60,angle=0", fit, 256)) ASSERT_GT(v, 1.0f - 1e-5f);
        // along the view's axis, either way, inside the frustum, wider than one layer
        for (const char* light : {"sun,elevation=89,angle=0", "sun,direction=0/1/0,angle=0",
                 "spot,position=0/4/1,target=0/0/0,cone=90,radius=0", "spot,position=0/4/1,target=0/0/0,cone=179,radius=0"})
            EXPECT_LT(wrong(room, down, light, fit), 0.03) << light;
    }
}

} // namespace
} // namespace gnomon
