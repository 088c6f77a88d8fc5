// SPDX-License-Identifier: Apache-2.0
// Occlusion textures as a whole, where visibility has a closed form, where the wrong answer is known, and where the input is bad.
#include "soft_fixture.h"

extern const gnomon::shadow::TechniqueInfo technique_occlusion_textures;

namespace gnomon {
namespace {

using gpu::add_blocker;
using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;
using gpu::square_light;

constexpr double sums = 0, n_buffer = 1, mips = 2;
constexpr double product = 0, sum = 1, greatest = 2, mean_of_both = 3, joined = 4;
constexpr double uniform = 0, fitted = 2;
constexpr double none = 0;

class OcclusionTextures : public gpu::SoftTest {
protected:
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return TechniqueTest::draw(technique_occlusion_textures, s, camera, size, light, values);
    }
    static double at_origin(const scene::Scene& s, const char* light, const Values& values)
    {
        return SoftTest::at_origin(technique_occlusion_textures, s, light, values);
    }
};

TEST_F(OcclusionTextures, HalfPlanesAreRampsWithinATexel)
{
    // the penumbra is 0.3 m wide; a texel of the sheet, 4 m from the light, is 4 * 2 / 766 = 0.0104 m, on the floor 0.013 m, of which half
    // at the edge; N-buffers and mips interpolate between widths that are powers of two, and mips between texels as wide
    const std::pair<double, double> filters[] = {{sums, 0.025}, {n_buffer, 0.1}, {mips, 0.15}};
    for (const auto& [filter, allowed] : filters)
        for (const double placement : {uniform, 1.0, fitted})
            EXPECT_LE(half_plane_error(technique_occlusion_textures, "rect,position=0/5/0,target=0/0/0,width=1.2,height=1.2",
                          {{"prefilter", filter}, {"placement", placement}}),
                allowed)
                << "prefilter " << filter << ", placement " << placement;
}

TEST_F(OcclusionTextures, RectanglesHideTheirShare)
{
    scene::Scene s = floor_scene(4);
    add_blocker(s, 2, {-0.3f, -0.1f}, {0.2f, 0.45f});
    // a texel of the sheet is 0.0052 m, from here 0.0104 of the light: half of one at each edge
    EXPECT_NEAR(at_origin(s, square_light, {}), 1 - 0.5 * 0.55, 0.012);
    EXPECT_NEAR(at_origin(s, square_light, {{"prefilter", n_buffer}}), 1 - 0.5 * 0.55, 0.05);
    EXPECT_NEAR(at_origin(s, square_light, {{"prefilter", mips}}), 1 - 0.5 * 0.55, 0.2)
        << "a mean of four squares, each twice as wide as the window at worst";
}

TEST_F(OcclusionTextures, WideWindowsAreCountedInParts)
{
    // a sheet 0.4 m below the light: its window is 0.9 m wide, half the map and twice as much as half words count
    scene::Scene s = floor_scene(4);
    add_blocker(s, 3.6f, {-0.3f, -0.2f}, {0.2f, 0.4f});
    EXPECT_NEAR(at_origin(s, square_light, {{"map_size", 2048}}), 1 - 0.5 * 0.6, 0.01);
    EXPECT_NEAR(at_origin(s, square_light, {{"map_size", 256}}), 1 - 0.5 * 0.6, 0.02) << "the same in one part";
}

TEST_F(OcclusionTextures, EdgesBeforeRoundLightsAreRamps)
{
    expect_ramps_before_disks(technique_occlusion_textures, 0.016, {}); // half a texel
}

TEST_F(OcclusionTextures, FusionIsAGuess)
{
    // 30 % and 70 % of the light: side by side, overlapping by 10 %, and one within the other. All that the guesses know is the two
    // numbers.
    for (const float begin : {-0.2f, -0.3f, -0.5f}) {
        scene::Scene s = floor_scene(4);
        add_blocker(s, 1.5f, {-0.5f, -0.5f}, {-0.2f, 0.5f});
        add_blocker(s, 0.7f, {begin, -0.5f}, {begin + 0.7f, 0.5f});
        const auto hidden = [&](double fusion) { return 1 - at_origin(s, square_light, {{"fusion", fusion}}); };
        // half a texel at each edge: 0.004 of the light for the upper sheet, 0.013 for the lower
        EXPECT_NEAR(hidden(product), 1 - 0.7 * 0.3, 0.03) << begin;
        EXPECT_NEAR(hidden(sum), 1.0, 0.03) << begin;
        EXPECT_NEAR(hidden(greatest), 0.7, 0.03) << begin;
        EXPECT_NEAR(hidden(mean_of_both), 0.85, 0.03) << begin;
    }
}

TEST_F(OcclusionTextures, JoinedSlicesKeepTiltedSheetsWhole)
{
    // a sheet over all of the light that crosses many slices, each of which sees a band of it
    scene::Scene s = floor_scene(4);
    scene::Mesh roof;
    roof.positions = {{-1.5f, 1.2f, -2}, {-1.5f, 1.2f, 2}, {1.5f, 2.4f, 2}, {1.5f, 2.4f, -2}};
    roof.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(roof);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(roof);
    const Values even{{"placement", uniform}, {"slices", 16}, {"map_size", 512}};
    const auto with = [&](double fusion) {
        Values values = even;
        values.emplace_back("fusion", fusion);
        return at_origin(s, "rect,position=0/4/0,target=0/0/0,width=2,height=2", values);
    };
    EXPECT_GT(with(product), 0.15) << "bands of 1 / k of the light, taken for independent, leave (1 - 1 / k)^k of it";
    EXPECT_LT(with(sum), 0.03);
    EXPECT_LT(with(joined), 0.03);
}

/// A few sheets at several heights, and the floor below them.
scene::Scene clutter()
{
    scene::Scene s = floor_scene(3);
    add_quad(s, {-1, 0.5f, -0.4f}, 0.5f);
    add_quad(s, {0.2f, 1.0f, -0.2f}, 0.4f);
    add_quad(s, {0.4f, 1.7f, 0}, 0.5f);
    add_quad(s, {1.2f, 0.2f, 0.6f}, 0.4f);
    return s;
}

const scene::Camera from_the_side{.eye = {0, 2.5f, 3.5f}, .target = {0, 0.2f, 0}};
constexpr const char* lights[]
    = {"sun,elevation=60,azimuth=30,angle=6", "point,position=0.5/4/0.3,radius=0.3", "spot,position=1/4/1,target=0/0/0,cone=70,radius=0.2",
        "rect,position=0/4/0.5,target=0/0/0,width=0.8,height=0.5", "disk,position=0.4/4/0,target=0/0/0,radius=0.4"};

TEST_F(OcclusionTextures, ProductsLieBetweenSumsAndTheGreatest)
{
    for (const char* light : lights) {
        const auto with = [&](double fusion) {
            return draw(clutter(), from_the_side, {48, 36}, light, {{"fusion", fusion}, {"map_size", 256}});
        };
        const auto low = with(sum), high = with(greatest), between = with(product), half = with(mean_of_both);
        for (size_t i = 0; i < low.size(); ++i) {
            ASSERT_LE(low[i], between[i] + 1e-5f) << light;
            ASSERT_LE(between[i], high[i] + 1e-5f) << light;
            ASSERT_LE(low[i], half[i] + 1e-5f) << light;
            ASSERT_LE(half[i], high[i] + 1e-5f) << light;
        }
        EXPECT_GT(mean(high) - mean(low), 1e-4) << light << ": nowhere do two slices hide something";
    }
}

TEST_F(OcclusionTextures, BlockersInTheReceiversOwnSliceHideNothingUnlessCompared)
{
    // one slice holds all
    const auto blocked = draw(clutter(), from_the_side, {48, 36}, lights[1], {{"slices", 1}, {"own", none}});
    const auto nothing = draw(floor_scene(3), from_the_side, {48, 36}, lights[1], {{"slices", 1}, {"own", none}});
    for (size_t i = 0; i < blocked.size(); ++i)
        if (nothing[i] == 1.0f) {
            ASSERT_EQ(blocked[i], 1.0f);
        }
    const auto compared = draw(clutter(), from_the_side, {48, 36}, lights[1], {{"slices", 1}});
    EXPECT_LT(mean(compared), mean(blocked) - 0.05);
    // without a size of the light, one slice with comparisons is a shadow map
    const char* point = "point,position=0.5/4/0.3,radius=0";
    const auto hard = TechniqueTest::draw(technique_shadow_map, clutter(), from_the_side, {96, 72}, point, {});
    const auto own = draw(clutter(), from_the_side, {96, 72}, point, {{"slices", 1}});
    size_t different = 0;
    for (size_t i = 0; i < hard.size(); ++i) different += std::abs(own[i] - hard[i]) > 0.5f;
    EXPECT_LT(different, hard.size() / 100);
}

TEST_F(OcclusionTextures, LightsWithoutASizeCastHardShadows)
{
    for (const double fusion : {product, sum, greatest, joined}) expect_hard_shadows(technique_occlusion_textures, {{"fusion", fusion}});
}

TEST_F(OcclusionTextures, TiltedPlanesDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    for (const char* light :
        {"sun,elevation=60,azimuth=20,angle=5", "sun,elevation=15,azimuth=200,angle=5", "point,position=1/2/0.5,radius=0.4",
            "rect,position=3/3/3,target=0/0/0,width=2,height=1", "disk,position=3/2/-3,target=0/0/0,radius=1"})
        for (const double own : {0.0, 1.0}) {
            const std::vector<float> open = draw(s, camera, {64, 48}, light, {{"slices", 16}, {"own", own}, {"map_size", 512}});
            const std::vector<float> nothing = draw(s, camera, {64, 48}, light, {{"slices", 1}, {"own", none}, {"map_size", 512}});
            for (size_t i = 0; i < open.size(); ++i)
                if (nothing[i] > 0.999f) {
                    ASSERT_GT(open[i], 0.97f) << light << ", own " << own << ", pixel " << i;
                }
            EXPECT_NEAR(mean(open), mean(nothing), 0.01) << light << ", own " << own;
            EXPECT_GT(mean(open), 0.2) << light;
        }
}

TEST_F(OcclusionTextures, BadInputGivesFractions)
{
    std::vector<Values> ways;
    for (const double filter : {sums, n_buffer, mips})
        for (const auto& [fusion, slices] : {std::pair(product, 16.0), std::pair(joined, 5.0)})
            ways.push_back({{"prefilter", filter}, {"fusion", fusion}, {"slices", slices}});
    expect_fractions(technique_occlusion_textures, ways);
}

} // namespace
} // namespace gnomon
