// SPDX-License-Identifier: Apache-2.0
// Convolution soft shadow mapping as a whole, where visibility has a closed form, and where its input is bad.
#include "scene/analytic.h"
#include "technique_fixture.h"
#include "techniques/cssm/cssm.shared.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_cssm;
extern const gnomon::shadow::TechniqueInfo technique_pcss;
extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

class Cssm : public gpu::TechniqueTest {
protected:
    /// The visibility along y = 0, z = 0 from x = -half to half.
    static std::vector<float> profile(const scene::Scene& s, float half, const char* light, const Values& values)
    {
        const int n = 128;
        // a row of pixels, each 2 half / n wide
        return draw(technique_cssm, s, camera_above({0, 0, 0}, 0.9f, half / float(n)), {n, 1}, light, values);
    }
};

/// A sheet one metre above the floor over x < 0, wider than the penumbrae are.
scene::Scene half_plane()
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-4, 1, 0}, 4);
    return s;
}

TEST_F(Cssm, HalfPlanesAreRampsWithinRipples)
{
    const char* text = "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2";
    const scene::Light light = scene::parse_light(text, {}, half_plane().bounds());
    // the penumbra is 0.3 m wide, a texel of the face 1.25 tan(45) 2 * 5 / 1024 = 0.012 m on the floor
    const double texel = 1.5 * 0.012 / 0.3;
    struct Way {
        double terms, correction, prefilter, off;
    };
    // as it stands the series may be a ripple too dark where half of the window is blocked; mips blend windows with what is beside them
    const Way ways[] = {{4, CORRECT_LEVEL, CSSM_SUMS, texel}, {8, CORRECT_LEVEL, CSSM_SUMS, texel}, {16, CORRECT_LEVEL, CSSM_SUMS, texel},
        {16, CORRECT_NONE, CSSM_SUMS, texel + 0.16}, {4, CORRECT_LEVEL, CSSM_MIPS, texel + 0.12}};
    for (const Way& way : ways) {
        const auto got = profile(half_plane(), 0.4f, text,
            {{"terms", way.terms}, {"correction", way.correction}, {"prefilter", way.prefilter}, {"contact", 0}, {"map_size", 1024}});
        double off = 0;
        for (int i = 0; i < 128; ++i) {
            const float x = -0.4f + 0.8f * (float(i) + 0.5f) / 128;
            const double truth = scene::analytic::half_plane_visibility(light, {x, 0, 0}, 0, 1);
            off = std::max(off, std::abs(double(got[size_t(i)]) - truth));
        }
        EXPECT_LT(off, way.off) << way.terms << " terms, correction " << way.correction << ", prefilter " << way.prefilter;
    }
}

/// Sheets at several heights over each other: two planes in a window would be exact.
scene::Scene sheets()
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-0.6f, 0.4f, 0}, 0.5f);
    add_quad(s, {0, 1, 0.2f}, 0.5f);
    add_quad(s, {0.4f, 1.7f, -0.3f}, 0.5f);
    return s;
}

TEST_F(Cssm, MoreTermsAreNearerToComparingEveryTexel)
{
    const scene::Scene s = sheets();
    const scene::Camera camera = camera_above({0, 0, 0}, 0.3f, 1.2f);
    const char* light = "rect,position=0/6/0,target=0/0/0,width=1.5,height=1.5";
    const auto exhaustive = draw(technique_pcss, s, camera, {96, 64}, light, {{"pattern", 0}, {"centred", 0}, {"map_size", 512}});
    const auto off = [&](double terms, double correction) {
        const auto got = draw(technique_cssm, s, camera, {96, 64}, light, {{"terms", terms}, {"correction", correction}, {"contact", 0}});
        double sum = 0;
        for (size_t i = 0; i < got.size(); ++i) sum += double(std::abs(got[i] - exhaustive[i]));
        return sum / double(got.size());
    };
    for (const double correction : {double(CORRECT_NONE), double(CORRECT_LEVEL)}) {
        const double few = off(2, correction), four = off(4, correction), many = off(16, correction);
        EXPECT_LT(four, few) << correction;
        EXPECT_LT(many, four) << correction;
    }
    EXPECT_LT(off(16, CORRECT_LEVEL), 0.02);
}

TEST_F(Cssm, CorrectionsDarkenContacts)
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-2, 0.25f, 0}, 2);
    const char* light = "rect,position=0/5/0,target=0/0/0,width=0.8,height=0.8";
    // the penumbra is 0.8 * 0.25 / 4.75 = 0.042 m wide, half of the light in its mean
    const scene::Camera camera = camera_above({0, 0, 0}, 0.2f, 0.01f);
    const auto light_left = [&](double correction) {
        return mean(draw(technique_cssm, s, camera, {32, 32}, light,
            {{"correction", correction}, {"contact", 0}, {"sharpening", 30}, {"reach", 20}, {"map_size", 1024}}));
    };
    const double none = light_left(CORRECT_NONE), sharpened = light_left(CORRECT_SHARPEN);
    EXPECT_GT(none, 0.65);
    EXPECT_LT(sharpened, none - 0.2);
    EXPECT_NEAR(light_left(CORRECT_LEVEL), 0.5, 0.1);
}

TEST_F(Cssm, LightsWithoutASizeCastHardShadows)
{
    scene::Scene s = floor_scene(4);
    add_quad(s, {-1, 1, 0}, 1);
    add_quad(s, {1, 0.3f, 0.5f}, 0.5f);
    const scene::Camera camera = camera_above({0, 0, 0}, 6, 2.5f);
    for (const char* light :
        {"sun,elevation=60,azimuth=20,angle=0", "spot,position=1/6/1,target=0/0/0,cone=80,radius=0", "point,position=0.5/4/0.3,radius=0"}) {
        const auto soft = draw(technique_cssm, s, camera, {128, 96}, light, {{"fit", 0}});
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

TEST_F(Cssm, BadInputGivesFractions)
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
            for (const double prefilter : {0.0, 1.0})
                for (const double correction : {0.0, 1.0, 2.0}) {
                    const auto got = draw(technique_cssm, s, camera, {48, 32}, light,
                        {{"map_size", size}, {"prefilter", prefilter}, {"correction", correction}, {"least", 0}, {"contact", 0}});
                    for (const float v : got) ASSERT_TRUE(v >= 0.0f && v <= 1.0f) << light << ": " << v;
                }
}

} // namespace
} // namespace gnomon
