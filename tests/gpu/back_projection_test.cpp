// SPDX-License-Identifier: Apache-2.0
// The technique as a whole on scenes of a few sheets, where visibility has a closed form.
#include "soft_fixture.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_back_projection;

namespace gnomon {
namespace {

using gpu::add_blocker;
using gpu::add_sheet;
using gpu::camera_above;
using gpu::floor_scene;
using gpu::square_light;

constexpr double area = 0, bitmask8 = 1, bitmask16 = 2;
constexpr double patches = 0, quads = 1, triangles = 2, mixed = 3;
constexpr double whole_map = 0, window = 1, umbra = 2;
constexpr double pyramid = 0, y_map = 1, multiscale = 2;
constexpr double of_window = 0, of_casters = 1; // levels

constexpr const char* disk_light = "disk,position=0/4/0,target=0/0/0,radius=0.5";

class BackProjection : public gpu::SoftTest {
protected:
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return TechniqueTest::draw(technique_back_projection, s, camera, size, light, values);
    }
    static double at_origin(const scene::Scene& s, const char* light, const Values& values)
    {
        return SoftTest::at_origin(technique_back_projection, s, light, values);
    }
};

TEST_F(BackProjection, HalfPlanesGiveTheAreaBesideTheEdge)
{
    for (const float edge : {-0.4f, 0.05f, 0.3f}) {
        scene::Scene s = floor_scene(4);
        add_blocker(s, 1.5f, {-3, -3}, {edge, 3});
        const double q = double(edge) / 0.5;
        const double square = 0.5 - 0.5 * q, disk = 0.5 - (q * std::sqrt(1 - q * q) + std::asin(q)) / 3.14159265;
        for (const double occluder : {patches, quads, triangles}) {
            // A texel of 1024 over 90 degrees and a rim is 2 / 766 wide at unit distance, and projected from here to the light 4 z / (4 -
            // z) times that. Patches err by half of one either way, quads by up to one, towards the light.
            const double texel = 2.0 / 766 * 4 * 2.5 / 1.5;
            const double more = occluder == patches ? 0.5 * texel : texel, less = occluder == patches ? -0.5 * texel : 0.0;
            for (const auto& [how, sampling] : {std::pair(area, 0.0), std::pair(bitmask8, 1.0 / 64), std::pair(bitmask16, 1.0 / 256)}) {
                const double got
                    = at_origin(s, square_light, {{"levels", of_window}, {"budget", 64}, {"occluders", occluder}, {"accumulate", how}});
                EXPECT_GE(got - square, less - sampling - 1e-3) << "edge " << edge << ", occluders " << occluder << ", accumulate " << how;
                EXPECT_LE(got - square, more + sampling + 1e-3) << "edge " << edge << ", occluders " << occluder << ", accumulate " << how;
                // an area of the square as large as the disk is off by up to 0.04
                const double shape = how == area ? 0.045 : 0.02;
                const double round
                    = at_origin(s, disk_light, {{"levels", of_window}, {"budget", 64}, {"occluders", occluder}, {"accumulate", how}});
                EXPECT_NEAR(round, disk, shape + 2 * sampling) << "edge " << edge << ", occluders " << occluder << ", accumulate " << how;
            }
        }
    }
}

TEST_F(BackProjection, CoarsePatchesWidenCastersAndCoarseQuadsHardlyDo)
{
    // 60 texels wide, in at most 16: two levels up. Nearest depths move edges outwards by 1.5 fine texels on average, quads inwards by 2.
    const double texel = 2.0 / 766 * 4 * 2.5 / 1.5;
    double patch_error = 0, quad_error = 0;
    constexpr int count = 16;
    for (int i = 0; i < count; ++i) {
        const float edge = -0.2f + 0.4f * float(i) / count;
        scene::Scene s = floor_scene(4);
        add_blocker(s, 1.5f, {-3, -3}, {edge, 3});
        const double want = 0.5 - double(edge);
        patch_error += (at_origin(s, square_light, {{"occluders", patches}, {"levels", of_window}, {"budget", 16}}) - want) / count;
        quad_error += (at_origin(s, square_light, {{"occluders", mixed}, {"levels", of_window}, {"budget", 16}}) - want) / count;
    }
    EXPECT_NEAR(patch_error, -1.5 * texel, 0.7 * texel);
    EXPECT_NEAR(quad_error, 0.5 * texel, 0.7 * texel);
}

TEST_F(BackProjection, RectanglesHideTheirShare)
{
    scene::Scene s = floor_scene(4);
    add_blocker(s, 2, {-0.3f, -0.1f}, {0.2f, 0.45f});
    for (const double occluder : {patches, quads, triangles})
        EXPECT_NEAR(at_origin(s, square_light, {{"levels", of_window}, {"budget", 64}, {"occluders", occluder}}), 1 - 0.5 * 0.55, 0.02)
            << occluder;
}

TEST_F(BackProjection, MasksCountOverlapsOnce)
{
    // 30 % and 70 % of the light: side by side, overlapping by 10 %, and one within the other. Neither hides the other from the light's
    // centre, and the window holds no more texels than the budget.
    const std::pair<float, double> arrangements[] = {{-0.2f, 1.0}, {-0.3f, 0.9}, {-0.5f, 0.7}};
    for (const auto& [begin, hidden] : arrangements) {
        scene::Scene s = floor_scene(4);
        add_blocker(s, 1.5f, {-0.5f, -0.5f}, {-0.2f, 0.5f});
        add_blocker(s, 0.7f, {begin, -0.5f}, {begin + 0.7f, 0.5f});
        // half a texel at each edge: 0.009 of the light for the upper one, 0.025 for the lower
        const auto visible = [&](double how) { return at_origin(s, square_light, {{"accumulate", how}, {"gaps", 0}}); };
        EXPECT_NEAR(visible(bitmask16), 1 - hidden, 0.04) << begin;
        EXPECT_NEAR(visible(bitmask8), 1 - hidden, 0.05) << begin;
        EXPECT_NEAR(visible(area), 0.0, 0.04) << begin << ": areas add up to all of the light";
    }
}

/// A few sheets at several heights, and the floor below them.
scene::Scene clutter()
{
    scene::Scene s = floor_scene(3);
    add_sheet(s, 0.5f, {-1.5f, -1}, {-0.4f, 0.2f});
    add_sheet(s, 1.0f, {-0.2f, -0.5f}, {0.5f, 0.1f});
    add_sheet(s, 1.7f, {0.3f, -1.2f}, {0.45f, 1.2f});
    add_sheet(s, 0.2f, {0.8f, 0.2f}, {1.6f, 1.0f});
    return s;
}

const scene::Camera from_the_side{.eye = {0, 2.5f, 3.5f}, .target = {0, 0.2f, 0}};
constexpr const char* lights[]
    = {"sun,elevation=60,azimuth=30,angle=6", "point,position=0.5/4/0.3,radius=0.3", "spot,position=1/4/1,target=0/0/0,cone=70,radius=0.2",
        "rect,position=0/4/0.5,target=0/0/0,width=0.8,height=0.5", "disk,position=0.4/4/0,target=0/0/0,radius=0.4"};

TEST_F(BackProjection, SlicesOfCastersErrByAPartOfTheLight)
{
    // Edges that cut the light at one place, in sheets from right under it to right above the receiver: a texel is one of the map or
    // between 1 / (budget - 1) and 2 / (budget - 1) of the light wide. Half of one either way, however the height changes the level.
    const double edge = 0.13;
    for (const double budget : {8.0, 32.0})
        for (float height = 0.6f; height < 3.6f; height += 0.23f) {
            scene::Scene s = floor_scene(4);
            add_blocker(s, height, {-3, -3}, {float(edge), 3});
            const double fine = 2.0 / 766 * 4 * double(4 - height) / double(height);
            const double got = at_origin(s, square_light, {{"budget", budget}});
            EXPECT_NEAR(got, 0.5 - edge, std::max(0.5 * fine, 1.0 / (budget - 1)) + 0.006) << "height " << height << ", budget " << budget;
        }
}

TEST_F(BackProjection, LayersHoldWhatTheLightsCentreDoesNotSee)
{
    // the upper sheet hides all of the lower one from the centre, but next to nothing of the light from the receiver
    scene::Scene s = floor_scene(4);
    add_sheet(s, 3, {-0.03f, -0.03f}, {0.03f, 0.03f});
    add_sheet(s, 1, {-0.08f, -0.08f}, {0.08f, 0.08f});
    const double upper = 0.08 * 0.08, lower = 0.64 * 0.64;
    EXPECT_NEAR(at_origin(s, square_light, {{"layers", 1}}), 1 - upper, 0.01);
    EXPECT_NEAR(at_origin(s, square_light, {{"layers", 2}}), 1 - lower, 0.03);
}

TEST_F(BackProjection, FurtherLayersOnlyDarken)
{
    const scene::Scene s = clutter();
    for (const char* light : lights) {
        const auto with = [&](double layers) { return draw(s, from_the_side, {48, 36}, light, {{"layers", layers}}); };
        std::vector<float> fewer = with(1);
        for (const double layers : {2.0, 3.0}) {
            const std::vector<float> more = with(layers);
            for (size_t i = 0; i < more.size(); ++i) ASSERT_LE(more[i], fewer[i]) << light << ", layers " << layers;
            fewer = more;
        }
        EXPECT_EQ(with(5), with(8)) << light << ": nothing has five sheets behind one another";
    }
}

TEST_F(BackProjection, SheetsModelledTwiceAreOneLayer)
{
    scene::Scene once = clutter(), twice = clutter();
    const std::vector<scene::Instance> instances = twice.instances;
    twice.instances.insert(twice.instances.end(), instances.begin(), instances.end());
    for (const char* light : lights)
        EXPECT_EQ(draw(once, from_the_side, {48, 36}, light, {{"layers", 2}}), draw(twice, from_the_side, {48, 36}, light, {{"layers", 2}}))
            << light;
}

TEST_F(BackProjection, PanelsSeenFromBesideAreExact)
{
    // A panel that stands upright, 2 m high from y = 1 m on, and a sheet before a receiver close to it: the ray to the height y crosses the
    // sheet at x = 0.7 (1 - 0.6 / y). With its edge at 0.35 m the sheet hides all above y = 1.2 m; were the rays parallel, as from afar,
    // all.
    scene::Scene s = floor_scene(6);
    add_sheet(s, 0.6f, {0.35f, -3}, {3, 3});
    const scene::Camera camera = camera_above({0.7f, 0, 0}, 0.05f, 1e-4f);
    const double got = mean(draw(s, camera, {2, 2}, "rect,position=0/2/0,target=4/2/0,width=1.6,height=2", {{"budget", 64}}));
    EXPECT_NEAR(got, 0.1, 0.02);
}

TEST_F(BackProjection, BodiesDoNotShadowTheirOwnSides)
{
    // the wall's plane hides the middle of the light, but not all of it; the top, which is nearer to the light, hides nothing more
    scene::Scene s = floor_scene(6);
    add_sheet(s, 1, {-1, -2}, {0, 2});
    scene::Mesh wall;
    wall.positions = {{0, 0, -2}, {0, 1, -2}, {0, 1, 2}, {0, 0, 2}};
    wall.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(wall);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(wall);
    const scene::Camera camera{.eye = {2, 0.5f, 0}, .target = {0, 0.5f, 0}, .half_height = 0.3f};
    for (const double layers : {1.0, 2.0}) {
        const std::vector<float> v
            = draw(s, camera, {8, 8}, "rect,position=-0.2/4/0,target=-0.2/0/0,width=1,height=1", {{"layers", layers}});
        for (const float x : v) ASSERT_NEAR(x, 0.3, 0.01) << "layers " << layers;
    }
}

TEST_F(BackProjection, WindowsHoldAllThatTheWholeMapHolds)
{
    const scene::Scene s = clutter();
    for (const char* light : lights)
        for (const auto& [occluder, levels] : {std::pair(patches, of_window), std::pair(quads, of_window), std::pair(triangles, of_window),
                 std::pair(patches, of_casters), std::pair(quads, of_casters)})
            for (const double gaps : {0.0, 1.0}) {
                const Values values{{"occluders", occluder}, {"gaps", gaps}, {"map_size", 64}, {"levels", levels},
                    {"budget", levels == of_casters ? 8.0 : 64.0}};
                Values all = values, some = values;
                all.emplace_back("search", whole_map), some.emplace_back("search", window);
                const std::vector<float> want = draw(s, from_the_side, {48, 36}, light, all);
                some.emplace_back("ranges", pyramid);
                for (const double ranges : {pyramid, y_map, multiscale}) {
                    some.back().second = ranges;
                    EXPECT_EQ(draw(s, from_the_side, {48, 36}, light, some), want)
                        << light << ", occluders " << occluder << ", levels " << levels << ", gaps " << gaps << ", ranges " << ranges;
                }
            }
}

TEST_F(BackProjection, UmbrasAreThoseOfTheWindow)
{
    const scene::Scene s = clutter();
    for (const char* light : lights) {
        const std::vector<float> a = draw(s, from_the_side, {48, 36}, light, {{"search", window}});
        const std::vector<float> b = draw(s, from_the_side, {48, 36}, light, {{"search", umbra}});
        for (size_t i = 0; i < a.size(); ++i) ASSERT_LE(b[i], a[i]) << light; // where a window is full, gaps within it are lost
        EXPECT_NEAR(mean(a), mean(b), 1e-3) << light;
    }
}

TEST_F(BackProjection, LightsWithoutSizeGiveTheHardComparison)
{
    const scene::Scene s = clutter();
    for (const char* light :
        {"sun,elevation=60,azimuth=30,angle=0", "point,position=0.5/4/0.3,radius=0", "spot,position=1/4/1,target=0/0/0,cone=70,radius=0"}) {
        const std::vector<float> v = draw(s, from_the_side, {96, 72}, light, {{"gaps", 0}});
        size_t between = 0;
        for (const float x : v) between += x != 0.0f && x != 1.0f;
        EXPECT_LE(between, 1u) << light;
        // the sheets are across the sun or nearly so: all of a receiver's texel blocks, or none of it
        for (const double how : {area, bitmask8})
            EXPECT_EQ(v, draw(s, from_the_side, {96, 72}, light, {{"gaps", 0}, {"accumulate", how}})) << light << ", accumulate " << how;
        EXPECT_GT(mean(v), 0.3) << light;
        EXPECT_LT(mean(v), 0.97) << light;
    }
}

TEST_F(BackProjection, MasksNeverHideMoreThanAreas)
{
    const scene::Scene s = clutter();
    for (const char* light : lights) {
        if (light[0] != 'r') continue; // areas of disks are those of squares
        const std::vector<float> sum = draw(s, from_the_side, {48, 36}, light, {{"accumulate", area}, {"search", window}});
        const std::vector<float> mask = draw(s, from_the_side, {48, 36}, light, {{"accumulate", bitmask16}, {"search", window}});
        for (size_t i = 0; i < sum.size(); ++i) ASSERT_LE(sum[i], mask[i] + 0.03f) << light << ", pixel " << i;
    }
}

TEST_F(BackProjection, TrianglesHideNoLessThanQuads)
{
    const scene::Scene s = clutter();
    for (const char* light : lights) {
        const std::vector<float> with = draw(s, from_the_side, {48, 36}, light, {{"occluders", triangles}});
        const std::vector<float> without = draw(s, from_the_side, {48, 36}, light, {{"occluders", quads}});
        for (size_t i = 0; i < with.size(); ++i) ASSERT_LE(with[i], without[i]) << light << ", pixel " << i;
    }
}

TEST_F(BackProjection, TiltedPlanesDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    for (const char* light :
        {"sun,elevation=60,azimuth=20,angle=5", "sun,elevation=15,azimuth=200,angle=5", "point,position=1/2/0.5,radius=0.4",
            "rect,position=3/3/3,target=0/0/0,width=2,height=1", "disk,position=3/2/-3,target=0/0/0,radius=1"})
        for (const double budget : {8.0, 64.0}) {
            const std::vector<float> open = draw(s, camera, {64, 48}, light, {{"budget", budget}});
            const std::vector<float> nothing = draw(s, camera, {64, 48}, light, {{"budget", budget}, {"bias", 16}});
            EXPECT_NEAR(mean(open), mean(nothing), 1e-4) << light << ", budget " << budget;
            EXPECT_GT(mean(open), 0.2) << light;
        }
}

TEST_F(BackProjection, HugeLightsAndSmallMapsStayInRange)
{
    const scene::Scene s = clutter();
    for (const char* light : {"sun,elevation=60,azimuth=30,angle=120", "point,position=0.5/1.2/0.3,radius=30",
             "rect,position=0/0.5/0.5,target=0/0/0,width=50,height=30", "disk,position=0/0/0,target=0/-1/0,radius=20",
             "rect,position=0/4/0.5,target=0/0/0,width=0.000001,height=0.000001", "spot,position=0/0.2/0,target=0/0/0,cone=170,radius=5"})
        for (const double occluder : {patches, triangles})
            for (const double map_size : {16.0, 200.0})
                for (const float v : draw(s, from_the_side, {48, 36}, light, {{"occluders", occluder}, {"map_size", map_size}}))
                    ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 1.0f) << light << ", map of " << map_size;
}

} // namespace
} // namespace gnomon
