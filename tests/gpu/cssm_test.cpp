// SPDX-License-Identifier: Apache-2.0
// Convolution soft shadow mapping as a whole, where visibility has a closed form, and where its input is bad.
#include "soft_fixture.h"
#include "techniques/cssm/cssm.shared.h"

extern const gnomon::shadow::TechniqueInfo technique_cssm;
extern const gnomon::shadow::TechniqueInfo technique_pcss;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

class Cssm : public gpu::SoftTest { };

TEST_F(Cssm, HalfPlanesAreRampsWithinRipples)
{
    const char* text = "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2";
    // the penumbra is 0.3 m wide, a texel of the face 1.25 tan(45) 2 * 5 / 1024 = 0.012 m on the floor
    const double texel = 1.5 * 0.012 / 0.3;
    struct Way {
        double terms, correction, prefilter, off;
    };
    // as it stands the series may be a ripple too dark where half of the window is blocked; mips blend windows with what is beside them
    const Way ways[] = {{4, CORRECT_LEVEL, CSSM_SUMS, texel}, {8, CORRECT_LEVEL, CSSM_SUMS, texel}, {16, CORRECT_LEVEL, CSSM_SUMS, texel},
        {16, CORRECT_NONE, CSSM_SUMS, texel + 0.16}, {4, CORRECT_LEVEL, CSSM_MIPS, texel + 0.12}};
    for (const Way& way : ways) {
        const double off = half_plane_error(technique_cssm, text,
            {{"terms", way.terms}, {"correction", way.correction}, {"prefilter", way.prefilter}, {"contact", 0}, {"map_size", 1024}});
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

TEST_F(Cssm, LightsWithoutASizeCastHardShadows) { expect_hard_shadows(technique_cssm, {}); }

TEST_F(Cssm, BadInputGivesFractions)
{
    std::vector<Values> ways;
    for (const double prefilter : {0.0, 1.0})
        for (const double correction : {0.0, 1.0, 2.0})
            ways.push_back({{"prefilter", prefilter}, {"correction", correction}, {"least", 0}, {"contact", 0}});
    expect_fractions(technique_cssm, ways);
}

} // namespace
} // namespace gnomon
