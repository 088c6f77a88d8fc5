// SPDX-License-Identifier: Apache-2.0
// Cascades under shadow_map's own resolve shader, with the map's block of constants changed at will.
#include "technique_fixture.h"
#include "tests/light_map_twin.h"

#include "shadow/light_constants.h"
#include "shadow/parts/bias.h"
#include "shadow/parts/fit.h"
#include "techniques/shadow_map/shadow_map.shared.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

namespace gnomon {
namespace {

using shadow::parts::Fit;
using shadow::parts::LightMapSettings;
using techniques::shadow_map::Params;
using techniques::shadow_map::ResolveConstants;

constexpr gpu::Size picture{160, 90};
constexpr float guard = 3.5f; // of 3 x 3 bilinear taps

class CascadesTest : public gpu::TechniqueTest {
protected:
    static void SetUpTestSuite()
    {
        TechniqueTest::SetUpTestSuite();
        // a floor under rows of small sheets, along which the view looks
        for (int i = 0; i < 40; ++i)
            gpu::add_quad(scene_, {float(i % 4) * 1.3f - 2.0f, 0.4f, 7.5f - 0.4f * float(i)}, 0.17f + 0.003f * float(i));
    }

    static scene::View view_from(vec3 eye, vec3 target)
    {
        return scene::make_view({"", eye, target, {0, 1, 0}, 0.7f}, picture, scene_.bounds());
    }

    static LightMapSettings settings(const shaders::FitParams& fitting)
    {
        return {.size = 256, .fitting = fitting, .slope_bias = 3.75f, .guard_texels = guard};
    }

    /// What `view` sees, with casters in the layers of `drawn` and the rest of the block from `read`.
    static std::vector<float> draw(const scene::View& view, const shaders::LightMap& drawn, const shaders::LightMap& read)
    {
        shadow::SceneGpu resources(device(), scene_);
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, picture);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, resources, view, {.material = false});
        const shadow::Frame frame{scene_, view, light_, resources, g, passes.import(out), 0};
        const gpu::ImageId depth
            = passes.transient({VK_FORMAT_D32_SFLOAT, {256, 256}, drawn.layer_count, 1, VK_SAMPLE_COUNT_1_BIT, false, "map"});
        shadow::parts::draw_light_layers(passes, frame, drawn, settings({}), depth);
        resolve(passes, frame, {depth, read, {}});
        device().submit(std::move(passes));
        return device().read_back(out).values;
    }

    /// shadow_map's own, of 3 x 3 bilinear taps.
    static void resolve(gpu::PassList& passes, const shadow::Frame& frame, const shadow::parts::LightMap& map)
    {
        const Params params{.bias = {.kind = BIAS_SLOPE}};
        const gpu::SpecConstant modes[] = {{0, 3u}, {1, uint32_t(params.bias.kind)}, {2, 1u}};
        const shadow::GBuffer& g = frame.gbuffer;
        passes.fullscreen({.name = "resolve",
            .program = &device().raster_program("shaders/fullscreen.vert", "techniques/shadow_map/shadow_map_resolve.frag", modes),
            .bindings = {{g.depth, gpu::Use::sample}, {g.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {g.primitive, gpu::Use::sample},
                gpu::Binding(g.primitive, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                {passes.import(frame.resources.instances()), gpu::Use::load}},
            .constants = with_map(ResolveConstants{shadow::view_constants(frame.view, 0), shadow::light_constants(light_, scene_.bounds()),
                                      map.constants, params, guard - 1.0f},
                map, offsetof(ResolveConstants, map)),
            .colors = {{frame.output}}});
    }

    /// What `view` sees with a map that is fitted for another view, on the GPU too.
    static std::vector<float> draw_fitted_for(const scene::View& other, const scene::View& view, const shaders::FitParams& fitting)
    {
        shadow::SceneGpu resources(device(), scene_);
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, picture);
        gpu::PassList passes(device());
        const shadow::GBuffer before = shadow::draw_gbuffer(passes, resources, other, {.material = false});
        const auto map = shadow::parts::draw_light_map(passes, {scene_, other, light_, resources, before, {}, 0}, settings(fitting));
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, resources, view, {.material = false});
        resolve(passes, {scene_, view, light_, resources, g, passes.import(out), 0}, map);
        device().submit(std::move(passes));
        return device().read_back(out).values;
    }

    static shaders::LightMap fit(const scene::View& view, const shaders::FitParams& fitting)
    {
        return shadow::parts::fit_light_map(scene_, scene_.bounds(), view, light_, settings(fitting));
    }

    /// The floor's point in each pixel; what lies above it is seen too, but not at these points.
    static std::vector<vec3> floor_points(const scene::View& view)
    {
        std::vector<vec3> points;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const scene::Ray ray = scene::view_ray(view, vec2(x, y) + 0.5f);
                points.push_back(ray.origin - ray.direction * (ray.origin.y / ray.direction.y));
            }
        return points;
    }

    inline static scene::Scene scene_ = gpu::floor_scene(8);
    inline static const scene::Light light_ = scene::parse_light("sun,elevation=50,azimuth=75,angle=0", {}, {{-8, 0, -8}, {8, 0.4f, 8}});
};

/// No layer ends before any distance.
void only_layer(shaders::LightMap& map, uint32_t layer)
{
    for (int i = 0; i < LIGHT_MAP_MAX_LAYERS; ++i) {
        const float end = i < int(layer) ? std::numeric_limits<float>::lowest() : std::numeric_limits<float>::max();
        map.splits[i / 4][i % 4] = map.bands[i / 4][i % 4] = end;
    }
}

TEST_F(CascadesTest, BlendWithinBandsOnly)
{
    const scene::View view = view_from({0, 2.5f, 8.5f}, {0, 0, 2});
    const shaders::LightMap map = fit(view, {.fit = int(Fit::cascades), .split = 0.3f, .stable = 0, .blend = 0.5f});
    ASSERT_EQ(map.layer_count, 4u);
    const std::vector<float> blended = draw(view, map, map);
    shaders::LightMap hard_map = map;
    for (int k = 0; k < 2; ++k) hard_map.bands[k] = hard_map.splits[k];
    const std::vector<float> hard = draw(view, map, hard_map);
    std::vector<std::vector<float>> layers;
    for (uint32_t i = 0; i < 4; ++i) {
        shaders::LightMap one = map;
        only_layer(one, i);
        layers.push_back(draw(view, map, one));
    }
    const std::vector<vec3> points = floor_points(view);
    int in_bands = 0, changed = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const int layer = tests::select_layer(map, points[i]);
        const double next = tests::next_share(map, points[i]);
        // sheets are up to 0.4 m above the floor's point behind them: what pixels near a band's ends show is not known here
        vec3 before = points[i];
        before += (view.eye - before) * (0.4f / (view.eye.y - before.y));
        if (tests::select_layer(map, before) != layer || (tests::next_share(map, before) > 0.0) != (next > 0.0)) continue;
        if (next == 0.0) {
            EXPECT_EQ(blended[i], hard[i]) << i;
            EXPECT_EQ(blended[i], layers[size_t(layer)][i]) << i;
            continue;
        }
        ++in_bands;
        changed += blended[i] != hard[i];
        const float here = layers[size_t(layer)][i], after = layers[size_t(layer) + 1][i];
        EXPECT_GE(blended[i], std::min(here, after) - 1e-6f);
        EXPECT_LE(blended[i], std::max(here, after) + 1e-6f);
        if (std::abs(here - after) < 0.1f) continue;
        const double share = double((blended[i] - here) / (after - here));
        EXPECT_GE(share, tests::next_share(map, before) - 1e-3);
        EXPECT_LE(share, next + 1e-3);
    }
    EXPECT_GT(in_bands, 400);
    EXPECT_GT(changed, 10);
}

// A pixel keeps its visibility while the view, for which the cascades are fitted, moves by fractions of the finest texel and turns, as long
// as it stays in its cascade.
TEST_F(CascadesTest, StableOnesDoNotSwim)
{
    const scene::View still = view_from({0.2f, 2.5f, 8.5f}, {0, 0, 1});
    const std::vector<vec3> points = floor_points(still);
    const auto swimming = [&](int stable) {
        const shaders::FitParams fitting{.fit = int(Fit::cascades), .split = 0.3f, .stable = stable};
        const shaders::LightMap first = fit(still, fitting);
        const std::vector<float> start = draw(still, first, first);
        int swum = 0, judged = 0;
        for (int step = 1; step <= 64; ++step) {
            const float t = float(step) * first.layers[0].texel_metres;
            const vec3 eye(0.2f + 0.27f * t, 2.5f + 0.09f * t, 8.5f - 0.31f * t);
            const shaders::LightMap map = fit(view_from(eye, vec3(0.002f * float(step), 0, 1) - 0.31f * t * vec3(0, 0, 1)), fitting);
            const std::vector<float> now = draw(still, map, map);
            for (size_t i = 0; i < points.size(); ++i) {
                const vec3 above = points[i] + (still.eye - points[i]) * (0.4f / still.eye.y);
                const int layer = tests::select_layer(first, points[i]);
                bool keeps = true;
                for (const vec3 p : {points[i], above})
                    for (const shaders::LightMap* m : {&first, &map})
                        keeps = keeps && tests::select_layer(*m, p) == layer && tests::next_share(*m, p) == 0.0;
                judged += keeps;
                swum += keeps && std::abs(now[i] - start[i]) > 1.0f / 64;
            }
        }
        EXPECT_GT(judged, 64 * 4000);
        return swum;
    };
    EXPECT_EQ(swimming(1), 0);
    EXPECT_GT(swimming(0), 1000);
}

// Fits that follow the view closely give every edge new texels with every step. How many pixels change, of all, is what docs/shadow-maps.md
// tells.
TEST_F(CascadesTest, FitsThatFollowTheViewSwim)
{
    const scene::View still = view_from({0.2f, 2.5f, 8.5f}, {0, 0, 1});
    const float texel = fit(still, {.fit = int(Fit::cascades), .split = 0.3f}).layers[0].texel_metres;
    const auto share = [&](const shaders::FitParams& fitting) {
        const std::vector<float> start = draw_fitted_for(still, still, fitting);
        size_t swum = 0;
        for (int step = 1; step <= 64; ++step) {
            const float t = float(step) * texel;
            const scene::View moved = view_from(
                {0.2f + 0.27f * t, 2.5f + 0.09f * t, 8.5f - 0.31f * t}, vec3(0.002f * float(step), 0, 1) - 0.31f * t * vec3(0, 0, 1));
            const std::vector<float> now = draw_fitted_for(moved, still, fitting);
            for (size_t i = 0; i < now.size(); ++i) swum += std::abs(now[i] - start[i]) > 1.0f / 64;
        }
        return double(swum) / (64.0 * double(start.size()));
    };
    const double stable = share({.fit = int(Fit::cascades), .split = 0.3f});
    for (const auto& [name, fitting] :
        {std::pair<const char*, shaders::FitParams>{"focused", {.fit = int(Fit::focused)}}, {"lispsm", {.fit = int(Fit::lispsm)}},
            {"tight cascades", {.fit = int(Fit::cascades), .split = 0.3f, .stable = 0}}, {"sdsm", {.fit = int(Fit::sdsm)}}}) {
        const double swum = share(fitting);
        std::printf("%s: %.4f of all pixels swim (stable cascades, with their seams: %.4f)\n", name, swum, stable);
        EXPECT_GT(swum, stable) << name;
        EXPECT_LT(swum, 0.5) << name;
    }
}

} // namespace
} // namespace gnomon
