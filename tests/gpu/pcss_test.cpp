// SPDX-License-Identifier: Apache-2.0
// The technique as a whole, on scenes where penumbrae have a closed form, and on the two where it is known to be wrong.
#include "technique_fixture.h"

#include "scene/analytic.h"
#include "scene/generators/analytic_scenes.h"
#include "scene/load.h"

#include <algorithm>
#include <cmath>
#include <functional>

extern const gnomon::shadow::TechniqueInfo technique_pcss, technique_pcf, technique_ray_traced;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;

constexpr double grid = 0, poisson = 1, vogel = 2, receiver_plane = 0, cone = 1, pcf = 0, sums = 1;

class Pcss : public gpu::TechniqueTest {
protected:
    static constexpr int side = 48;

    static scene::Scene builtin(std::string_view name)
    {
        for (const scene::Builtin& b : scene::builtins())
            if (b.name == name) return b.make(0.1);
        throw std::logic_error("no built-in scene " + std::string(name));
    }

    static const scene::Light& light_of(const scene::Scene& s, std::string_view name)
    {
        return *std::find_if(s.lights.begin(), s.lights.end(), [&](const scene::Light& l) { return l.name == name; });
    }

    static std::vector<float> draw(const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera,
        const scene::Light& light, const Values& values)
    {
        scene::Scene lit = s;
        lit.lights = {light};
        lit.lights[0].name = "under test";
        return draw_parsed(info, lit, camera, lit.lights[0], values);
    }

    /// As TechniqueTest::draw, of a light that no text describes.
    static std::vector<float> draw_parsed(const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera,
        const scene::Light& light, const Values& values)
    {
        const scene::View view = scene::make_view(camera, {side, side}, s.bounds());
        shadow::ParamValues params(info.params());
        for (const auto& [name, value] : values) params.set(name, value);
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, {side, side});
        const std::unique_ptr<shadow::Technique> technique = info.create(device());
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        technique->record(passes, {s, view, light, scene, g, passes.import(out), 0}, params.bytes());
        device().submit(std::move(passes));
        return device().read_back(out).values;
    }

    struct Error {
        double worst = 0, mean = 0, between = 0; ///< between: fraction of the pixels in penumbra
    };

    /// Over the floor that camera_above(target, 1, half) sees.
    static Error compare(const std::vector<float>& v, vec3 target, float half, const std::function<double(vec3)>& closed_form)
    {
        Error out;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const vec2 at = (vec2(float(x), float(y)) + 0.5f) * (2.0f / float(side)) - 1.0f;
                const double wanted = closed_form(target + half * vec3(at.x, 0, at.y));
                const double error = std::abs(double(v[size_t(y * side + x)]) - wanted);
                out.worst = std::max(out.worst, error), out.mean += error / (side * side);
                out.between += (wanted > 0.01 && wanted < 0.99) / double(side * side);
            }
        return out;
    }
};

TEST_F(Pcss, AHalfPlaneBeforeAPanelGivesTheLinearRamp)
{
    const scene::Scene s = builtin("half_plane");
    const scene::Light light = light_of(s, "main");
    const vec3 target(1.2f, 0, 0);
    const auto ramp = [&](vec3 p) {
        return scene::analytic::half_plane_visibility(
            light, p, scene::analytic_scenes::half_plane_edge_x, scene::analytic_scenes::half_plane_y);
    };
    for (const double receiver : {receiver_plane, cone})
        for (const double refine : {0.0, 2.0}) {
            const auto v = draw(technique_pcss, s, camera_above(target, 1, 1.2f), light,
                {{"pattern", grid}, {"receiver", receiver}, {"refine", refine}, {"cap", 1024}, {"map_size", 512}});
            const Error e = compare(v, target, 1.2f, ramp);
            // the penumbra is 1.5 m wide: 19 texels; an edge lies within half of one
            EXPECT_LT(e.worst, 0.04) << receiver << " " << refine;
            EXPECT_LT(e.mean, 0.02) << receiver << " " << refine;
            EXPECT_GT(e.between, 0.4);
        }
}

TEST_F(Pcss, ARectangleBeforeAPanelGivesTheProductOfTwoRamps)
{
    const scene::Scene s = builtin("rect_blocker");
    const scene::Light light = light_of(s, "main");
    const auto product = [&](vec3 p) {
        return scene::analytic::rect_visibility(std::get<scene::RectLight>(light.shape), p, scene::analytic_scenes::rect_blocker_min,
            scene::analytic_scenes::rect_blocker_max, scene::analytic_scenes::rect_blocker_y);
    };
    const auto draw_with = [&](const Values& values) {
        return compare(draw(technique_pcss, s, camera_above(vec3(0), 1, 2.0f), light, values), vec3(0), 2.0f, product);
    };
    const Error exhaustive = draw_with({{"pattern", grid}, {"cap", 1024}, {"receiver", receiver_plane}});
    EXPECT_LT(exhaustive.worst, 0.05);
    EXPECT_LT(exhaustive.mean, 0.006);
    EXPECT_GT(exhaustive.between, 0.2);
    for (const double pattern : {poisson, vogel}) {
        const Error taps = draw_with({{"pattern", pattern}, {"cap", 1024}, {"search_taps", 64}, {"filter_taps", 128}, {"rotation", 0}});
        EXPECT_LT(taps.worst, 0.15) << pattern;
        EXPECT_LT(taps.mean, 0.015) << pattern;
    }
    // two depths and a level receiver: Chebyshev's bound is reached
    const Error summed = draw_with({{"pattern", grid}, {"cap", 256}, {"filtering", sums}, {"receiver", receiver_plane}});
    EXPECT_LT(summed.worst, 0.06);
    EXPECT_LT(summed.mean, 0.008);
}

TEST_F(Pcss, ADiskLightGivesASegmentsArea)
{
    const scene::Scene s = builtin("half_plane");
    const scene::Light light = light_of(s, "dish");
    const vec3 target(1.2f, 0, 0);
    const auto segment = [&](vec3 p) {
        return scene::analytic::half_plane_visibility(
            light, p, scene::analytic_scenes::half_plane_edge_x, scene::analytic_scenes::half_plane_y);
    };
    const auto draw_with = [&](const Values& values) {
        return compare(draw(technique_pcss, s, camera_above(target, 1, 1.2f), light, values), target, 1.2f, segment);
    };
    const Error exhaustive = draw_with({{"pattern", grid}, {"cap", 1024}});
    EXPECT_LT(exhaustive.worst, 0.03);
    EXPECT_LT(exhaustive.mean, 0.015);
    const Error taps = draw_with({{"pattern", vogel}, {"cap", 1024}, {"search_taps", 64}, {"filter_taps", 128}, {"rotation", 0}});
    EXPECT_LT(taps.worst, 0.06);
}

TEST_F(Pcss, ASunGivesTheSameProfileFromAnOrthographicMap)
{
    scene::Scene s = builtin("half_plane");
    scene::Light light = light_of(s, "main");
    const float radius = 0.04f;
    light.shape = scene::DirectionalLight{{0, -1, 0}, radius};
    const float width = scene::analytic_scenes::half_plane_y * std::tan(radius);
    const auto segment = [&](vec3 p) {
        const double q = std::clamp(double((p.x - scene::analytic_scenes::half_plane_edge_x) / width), -1.0, 1.0);
        return 0.5 + (q * std::sqrt(1 - q * q) + std::asin(q)) / double(pi);
    };
    const vec3 target(0, 0, 0);
    const auto v = draw(technique_pcss, s, camera_above(target, 1, 0.4f), light, {{"pattern", grid}, {"fit", 1}, {"cap", 1024}});
    const Error e = compare(v, target, 0.4f, segment);
    EXPECT_LT(e.worst, 0.06);
    EXPECT_GT(e.between, 0.15);
}

/// What a tangent-space strip from x0 to x1 before a panel at height 4 is, at `depth` metres below it.
void add_strip(scene::Scene& s, float x0, float x1, float depth)
{
    scene::Mesh quad;
    quad.positions = {{x0 * depth, 4 - depth, -4}, {x0 * depth, 4 - depth, 4}, {x1 * depth, 4 - depth, 4}, {x1 * depth, 4 - depth, -4}};
    quad.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(quad);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(quad);
}

// Eisemann et al. 2011, figure 6.10. The light is 1 m wide and 4 m above the receiver: blockers 2 and 3.5 m below it matter within
// tangents of 0.125 and 0.0179. The upper one stands aside, but is found by the search, and draws the mean depth to 3.03 m: the filter then
// reaches to 0.04.
TEST_F(Pcss, BlockersAtSeveralDepthsGiveTheKnownWrongAnswers)
{
    scene::Light light;
    light.shape = scene::RectLight{{0, 4, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}};
    const auto at_origin = [&](float x0, float x1, const shadow::TechniqueInfo& info, const Values& values) {
        scene::Scene s = floor_scene(4);
        add_strip(s, 0.2f, 0.21824f, 2.0f);
        add_strip(s, x0, x1, 3.5f);
        const std::vector<float> v = draw(info, s, camera_above(vec3(0), 0.3f, 0.002f), light, values);
        return v[side / 2 * side + side / 2];
    };
    const Values exhaustive
        = {{"pattern", grid}, {"refine", 0}, {"centred", 0}, {"map_size", 4096}, {"cap", 1024}, {"receiver", receiver_plane}};
    EXPECT_NEAR(at_origin(0.02f, 0.06f, technique_pcss, exhaustive), 0.75f, 0.02f) << "in truth lit";
    EXPECT_NEAR(at_origin(-0.02f, 0.02f, technique_pcss, exhaustive), 0.5f, 0.03f) << "in truth dark";
    EXPECT_EQ(at_origin(0.02f, 0.06f, technique_ray_traced, {}), 1.0f);
    EXPECT_EQ(at_origin(-0.02f, 0.02f, technique_ray_traced, {}), 0.0f);
}

TEST_F(Pcss, ShadowsHardenAtContact)
{
    scene::Scene s = floor_scene(4);
    // a card that stands on the floor, x = 0, before a panel to its left
    scene::Mesh card;
    card.positions = {{0, 0, -2}, {0, 1, -2}, {0, 1, 2}, {0, 0, 2}};
    card.indices = {0, 1, 2, 0, 2, 3};
    scene::complete(card);
    s.instances.push_back({int(s.meshes.size()), mat4(1)});
    s.meshes.push_back(card);
    scene::Light light;
    light.shape = scene::RectLight{{-3, 3, 0}, glm::normalize(vec3(1, 1, 0)) * 0.3f, {0, 0, 0.3f}};
    const std::vector<float> v = draw(technique_pcss, s, camera_above({0, 0, 0}, 1.5f, 0.4f), light,
        {{"pattern", grid}, {"map_size", 2048}, {"receiver", receiver_plane}});
    // 17 mm a pixel; lit on the left, and from two pixels on dark on the right: a filter of fixed width would be grey there
    const auto at = [&](int x) { return v[size_t(side / 2 * side + x)]; };
    for (int x = 0; x < side / 2 - 1; ++x) EXPECT_GT(at(x), 0.95f) << x;
    for (int x = side / 2 + 2; x < side; ++x) EXPECT_LT(at(x), 0.05f) << x;
}

TEST_F(Pcss, ALightWithoutSizeIsTheHardComparisonOfItsMap)
{
    const scene::Scene s = builtin("contact");
    const scene::Camera camera = scene::fit_camera(s.bounds());
    for (const char* text :
        {"sun,elevation=40,azimuth=60,angle=0", "point,position=2/4/1,radius=0", "spot,position=3/4/2,target=0/0/0,cone=70,radius=0"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        for (const double pattern : {grid, vogel}) {
            const auto soft = draw(technique_pcss, s, camera, light, {{"pattern", pattern}, {"bias", 0}, {"map_size", 512}});
            const auto hard = draw(technique_pcf, s, camera, light, {{"kernel", 1}, {"bilinear", 0}, {"map_size", 512}});
            size_t differ = 0, dark = 0;
            for (size_t i = 0; i < soft.size(); ++i) {
                EXPECT_TRUE(soft[i] == 0.0f || soft[i] == 1.0f);
                differ += soft[i] != hard[i], dark += hard[i] == 0.0f;
            }
            EXPECT_LE(differ, soft.size() / 20) << text; // the two maps have rims of different width
            EXPECT_GT(dark, 10u) << text;
        }
    }
}

TEST_F(Pcss, TiltedPlanesDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    for (const char* text : {"sun,elevation=90,angle=4", "sun,elevation=30,azimuth=70,angle=4", "sun,elevation=10,azimuth=33,angle=4",
             "point,position=1/2/0.5,radius=0.6", "spot,position=4/3/1,target=-2/0/0,cone=80,radius=0.5",
             "rect,position=2/3/1,target=0/0/0,width=2,height=1", "disk,position=-2/3/1,target=0/0/0,radius=1"}) {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const std::vector<float> truth = draw(technique_ray_traced, s, camera, light, {{"samples", 256}});
        for (const double receiver : {receiver_plane, cone})
            for (const double pattern : {grid, vogel})
                for (const double shortcut : {0.0, 2.0}) {
                    const std::vector<float> v = draw(technique_pcss, s, camera, light,
                        {{"pattern", pattern}, {"receiver", receiver}, {"shortcut", shortcut}, {"refine", 0}, {"least", 16},
                            {"map_size", 256}});
                    float worst = 0;
                    for (size_t i = 0; i < v.size(); ++i) worst = std::max(worst, std::abs(v[i] - truth[i]));
                    EXPECT_LT(worst, 0.03f) << text << " receiver " << receiver << " pattern " << pattern << " shortcut " << shortcut;
                }
    }
}

TEST_F(Pcss, ShortcutsLoseNothing)
{
    const scene::Scene s = builtin("balls");
    const scene::Camera camera = scene::fit_camera(s.bounds());
    for (const char* text : {"rect,position=4/7/4,target=0/0.5/0,width=2.5,height=1.5", "sun,elevation=40,azimuth=60,angle=4",
             "point,position=3/7/2,radius=0.6"})
        for (const double receiver : {receiver_plane, cone})
            for (const double pattern : {grid, vogel}) {
                const scene::Light light = scene::parse_light(text, {}, s.bounds());
                const auto with = [&](double shortcut) {
                    return draw(technique_pcss, s, camera, light,
                        {{"pattern", pattern}, {"receiver", receiver}, {"shortcut", shortcut}, {"map_size", 512}});
                };
                const std::vector<float> none = with(0), lit = with(1), both = with(2);
                for (size_t i = 0; i < none.size(); ++i) {
                    ASSERT_NEAR(none[i], lit[i], 1e-6f) << text << " " << i;
                    ASSERT_NEAR(none[i], both[i], 1e-6f) << text << " " << i;
                }
            }
}

TEST_F(Pcss, OddLightsGiveFractions)
{
    const scene::Scene s = builtin("contact");
    const scene::Camera camera = scene::fit_camera(s.bounds());
    for (const char* text : {"rect,position=0/1/0,target=0/0/0,width=40,height=30", "disk,position=0/0/0,target=0/1/0,radius=3",
             "point,position=0/0.01/0,radius=9", "sun,elevation=50,angle=180", "point,position=0/-3/0,radius=1",
             "rect,position=0/3/0,target=0/9/0,width=1,height=1"})
        for (const double filtering : {pcf, sums}) {
            const scene::Light light = scene::parse_light(text, {}, s.bounds());
            for (const double map_size : {16.0, 256.0})
                for (const float v : draw(technique_pcss, s, camera, light, {{"filtering", filtering}, {"map_size", map_size}}))
                    ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 1.0f) << text << " " << v;
        }
}

} // namespace
} // namespace gnomon
