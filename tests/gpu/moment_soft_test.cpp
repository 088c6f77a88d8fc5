// SPDX-License-Identifier: Apache-2.0
// Moment soft shadow mapping as a whole, where visibility has a closed form, and where its input is bad.
#include "scene/analytic.h"
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_moment_soft;
extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

class MomentSoft : public gpu::TechniqueTest {
protected:
    /// The visibility along y = 0, z = 0 from x = -half to half.
    static std::vector<float> profile(const scene::Scene& s, float half, const char* light, const Values& values)
    {
        const int n = 128;
        // a row of pixels, each 2 half / n wide
        return draw(technique_moment_soft, s, camera_above({0, 0, 0}, 0.9f, half / float(n)), {n, 1}, light, values);
    }
};

/// A sheet one metre above the floor over x < 0, wider than the penumbrae are.
scene::Scene half_plane()
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-4, 1, 0}, 4);
    return s;
}

TEST_F(MomentSoft, HalfPlanesAreRampsWithinATexel)
{
    const char* text = "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2";
    const scene::Light light = scene::parse_light(text, {}, half_plane().bounds());
    for (const double grid : {1.0, 2.0, 3.0, 8.0}) {
        const auto got = profile(half_plane(), 0.4f, text, {{"grid", grid}, {"contact", 0}});
        for (int i = 0; i < 128; ++i) {
            const float x = -0.4f + 0.8f * (float(i) + 0.5f) / 128;
            const double truth = scene::analytic::half_plane_visibility(light, {x, 0, 0}, 0, 1);
            // the penumbra is 0.3 m wide, a texel of the face 1.25 tan(45) 2 * 5 / 1024 = 0.012 m on the floor
            ASSERT_NEAR(double(got[size_t(i)]), truth, 1.5 * 0.012 / 0.3) << "at " << x << ", grid " << grid;
        }
    }
}

TEST_F(MomentSoft, KernelsForDisksOfTheirAreaAreNearerThanThoseAroundThem)
{
    const char* text = "disk,position=0/5/0,target=0/0/0,radius=0.8";
    const scene::Light light = scene::parse_light(text, {}, half_plane().bounds());
    double off[2] = {};
    for (int kernel = 0; kernel < 2; ++kernel) {
        const auto got = profile(half_plane(), 0.4f, text, {{"kernel", double(kernel)}, {"contact", 0}});
        for (int i = 0; i < 128; ++i) {
            const float x = -0.4f + 0.8f * (float(i) + 0.5f) / 128;
            off[kernel]
                = std::max(off[kernel], std::abs(double(got[size_t(i)]) - scene::analytic::half_plane_visibility(light, {x, 0, 0}, 0, 1)));
        }
    }
    // a ramp against the area of a segment: off by at most 0.0577 around the disk, 0.0226 at its area; half a texel of a penumbra of 0.4 m
    EXPECT_LT(off[0], 0.0577 + 0.015);
    EXPECT_LT(off[1], 0.0226 + 0.015);
    EXPECT_GT(off[0], 0.05);
}

TEST_F(MomentSoft, LightsWithoutASizeCastHardShadows)
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-1, 1, 0}, 1);
    add_quad(s, {1, 0.3f, 0.5f}, 0.5f);
    const scene::Camera camera = camera_above({0, 0, 0}, 6, 2.5f);
    for (const char* light :
        {"sun,elevation=60,azimuth=20,angle=0", "spot,position=1/6/1,target=0/0/0,cone=80,radius=0", "point,position=0.5/4/0.3,radius=0"}) {
        const auto soft = draw(technique_moment_soft, s, camera, {128, 96}, light, {{"fit", 0}});
        const auto hard = draw(technique_shadow_map, s, camera, {128, 96}, light, {{"fit", 0}});
        size_t grey = 0, different = 0;
        for (size_t i = 0; i < soft.size(); ++i) {
            grey += soft[i] != 0.0f && soft[i] != 1.0f;
            different += std::abs(soft[i] - hard[i]) > 0.5f;
        }
        EXPECT_EQ(grey, 0u) << light;
        // the maps differ by the rim that soft methods leave, so that edges fall into other texels
        EXPECT_LT(different, soft.size() / 100) << light;
    }
}

TEST_F(MomentSoft, BadInputGivesFractions)
{
    scene::Scene s = floor_scene(2);
    add_quad(s, {0, 0.5f, 0}, 0.5f);
    const scene::Camera camera{.eye = {0, 3, 4}, .target = {0, 0, 0}};
    for (const char* light : {"sun,elevation=1,azimuth=20,angle=60", "sun,elevation=-30,azimuth=20,angle=5",
             "rect,position=0/1/0,target=0/0/0,width=100,height=100", "rect,position=0/0/0,target=1/0/0,width=1,height=1",
             "rect,position=0/1/0,target=0/0/0,width=0.00001,height=2", "disk,position=0/0.5/0,target=0/0/0,radius=3",
             "disk,position=0/-1/0,target=0/-2/0,radius=1", "point,position=0/0.5/0,radius=2", "point,position=0/0.001/1,radius=0.5",
             "spot,position=0/30/0,target=0/0/0,cone=1,radius=5"})
        for (const double size : {16.0, 64.0})
            for (const double sums : {0.0, 1.0})
                for (const auto& [bias, grid] : {std::pair(0.0, 1.0), std::pair(10000.0, 3.0)}) {
                    const auto got = draw(technique_moment_soft, s, camera, {48, 32}, light,
                        {{"map_size", size}, {"sums", sums}, {"moment_bias", bias}, {"grid", grid}});
                    for (const float v : got) ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << light << ": " << v;
                }
}

} // namespace
} // namespace gnomon
