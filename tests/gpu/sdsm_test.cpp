// SPDX-License-Identifier: Apache-2.0
#include "technique_fixture.h"

#include "shadow/light_constants.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sdsm.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon {
namespace {

using shadow::parts::Fit;

constexpr gpu::Size picture{150, 100};

uint32_t ordered(float f)
{
    const uint32_t bits = std::bit_cast<uint32_t>(f);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}

class Sdsm : public gpu::TechniqueTest {
protected:
    struct Fitted {
        shaders::FittedMap map;
        std::vector<vec4> samples; ///< seen
        shaders::LightMap before; ///< the CPU's
    };

    static Fitted fit(
        const scene::Scene& s, const scene::View& view, const shaders::FitParams& fitting, const char* sun = "sun,elevation=40,azimuth=70")
    {
        const scene::Light light = scene::parse_light(sun, {}, s.bounds());
        shadow::SceneGpu resources(device(), s);
        gpu::Buffer samples = storage<vec4>("samples", size_t(picture.width * picture.height));
        gpu::Buffer result = storage<shaders::FittedMap>("result", 1);
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, picture);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, resources, view, {.material = false});
        const shadow::Frame frame{s, view, light, resources, g, passes.import(out), 0};
        const shadow::parts::LightMapSettings settings{.size = 256, .fitting = fitting, .guard_texels = guard};
        Fitted fitted{};
        fitted.before = shadow::parts::fit_light_map(s, s.bounds(), view, light, settings);
        const gpu::BufferId buffer = shadow::parts::fit_to_samples(passes, frame, settings, fitted.before);
        passes.copy(buffer, passes.import(result), sizeof(shaders::FittedMap));
        const vec3 direction = std::get<scene::DirectionalLight>(light.shape).direction;
        passes.compute({.name = "samples",
            .program = &device().compute_program("tests/gpu/sdsm_samples.comp"),
            .bindings = {{g.depth, gpu::Use::sample}, {passes.import(samples), gpu::Use::store}},
            .constants = shaders::SdsmReduce{shadow::view_constants(view, 0),
                shadow::parts::light_axes(s.bounds().centre(), direction, vec3(0, 1, 0))},
            .threads = {uint32_t(picture.width), uint32_t(picture.height), 1}});
        device().submit(std::move(passes));
        fitted.map = values<shaders::FittedMap>(result)[0];
        for (const vec4 v : values<vec4>(samples))
            if (!std::isnan(v.w)) fitted.samples.push_back(v);
        return fitted;
    }

    static scene::View view_of(const scene::Scene& s, vec3 eye, vec3 target, float fov = 0.8f)
    {
        return scene::make_view({"", eye, target, {0, 1, 0}, fov}, picture, s.bounds());
    }

    /// Sheets of several sizes over a floor.
    static scene::Scene sheets()
    {
        scene::Scene s = gpu::floor_scene(30);
        for (int i = 0; i < 12; ++i) gpu::add_quad(s, {float(i % 5) * 3 - 6, 1.0f + 0.2f * float(i), float(i) * 4 - 24}, 0.7f);
        return s;
    }

    static constexpr float guard = 3.5f;
};

void expect_equal(const shaders::SampleBounds& b, const std::vector<vec4>& samples, vec2 range, const char* what)
{
    shaders::SampleBounds want;
    for (int k = 0; k < 4; ++k) want.least[k] = want.least_negated[k] = ~0u;
    for (const vec4& v : samples)
        for (int k = 0; k < 4; ++k) {
            if (v.x < range.x || v.x > range.y) continue;
            want.least[k] = std::min(want.least[k], ordered(v[k]));
            want.least_negated[k] = std::min(want.least_negated[k], ordered(-v[k]));
        }
    for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(b.least[k], want.least[k]) << what << k;
        EXPECT_EQ(b.least_negated[k], want.least_negated[k]) << what << k;
    }
}

TEST_F(Sdsm, ReducesAsTheCpuDoesBitForBit)
{
    const scene::Scene s = sheets();
    for (const vec3 eye : {vec3(0, 3, 28), vec3(-20, 12, 5)}) {
        const Fitted f = fit(s, view_of(s, eye, {0, 0, 0}), {.fit = int(Fit::sdsm)});
        ASSERT_GT(f.samples.size(), 5000u);
        ASSERT_LT(f.samples.size(), size_t(picture.width * picture.height)) << "background as well";
        expect_equal(f.map.all, f.samples, {-1e38f, 1e38f}, "all ");
        for (int i = 0; i < 4; ++i) expect_equal(f.map.cascades[i], f.samples, f.map.ranges[i], "cascade ");
    }
}

TEST_F(Sdsm, EndsHaveOneRatioBetweenTheNearestAndTheFurthestSample)
{
    const scene::Scene s = sheets();
    for (const int count : {1, 3, 4, 8}) {
        const Fitted f = fit(s, view_of(s, {0, 3, 28}, {0, 0, 0}), {.fit = int(Fit::sdsm), .cascades = count, .blend = 0.25f});
        float near = 1e38f, far = 0;
        for (const vec4& v : f.samples) near = std::min(near, v.x), far = std::max(far, v.x);
        const std::vector<float> ends = shadow::parts::cascade_ends(near, far, count, 1);
        ASSERT_EQ(f.map.map.layer_count, uint32_t(count));
        for (int i = 0; i + 1 < count; ++i) {
            const float start = i == 0 ? near : ends[size_t(i) - 1], end = ends[size_t(i)];
            EXPECT_NEAR(f.map.map.splits[i / 4][i % 4], end, 1e-4f * end);
            EXPECT_NEAR(f.map.map.bands[i / 4][i % 4], end - 0.25f * (end - start), 1e-4f * end);
        }
        EXPECT_GT(f.map.map.splits[(count - 1) / 4][(count - 1) % 4], 1e37f) << "the last has no end";
    }
}

TEST_F(Sdsm, LayersHoldTheirSamplesWithTheFiltersRadius)
{
    const scene::Scene s = sheets();
    for (const char* sun : {"sun,elevation=40,azimuth=70", "sun,elevation=8,azimuth=185", "sun,elevation=90"}) {
        const Fitted f = fit(s, view_of(s, {0, 3, 28}, {0, 0, 0}), {.fit = int(Fit::sdsm)}, sun);
        const vec3 direction = std::get<scene::DirectionalLight>(scene::parse_light(sun, {}, s.bounds()).shape).direction;
        const glm::dmat4 world_from_axes
            = glm::inverse(glm::dmat4(shadow::parts::light_axes(s.bounds().centre(), direction, vec3(0, 1, 0))));
        for (const vec4& v : f.samples)
            for (int i = 0; i < 4; ++i) {
                const float begin = i == 0 ? 0.0f : f.map.map.bands[0][i - 1];
                if (v.x < begin || v.x > f.map.map.splits[0][i]) continue;
                const shaders::LightMapLayer& layer = f.map.map.layers[i];
                const glm::dvec4 p = world_from_axes * glm::dvec4(v.y, v.z, v.w, 1);
                const glm::dvec4 uv = glm::dmat4(layer.map_from_world) * p;
                const double radius = double(guard) - 1.0 - 0.05;
                EXPECT_GE(std::min(uv.x, uv.y) * 256, radius) << i;
                EXPECT_LE(std::max(uv.x, uv.y) * 256, 256 - radius) << i;
                EXPECT_GT(uv.z, 0.0);
                EXPECT_LT(uv.z, 1.0);
                EXPECT_NEAR(glm::dot(glm::dvec4(layer.depth_plane), p), double(v.w), 1e-3);
                // and within what culls for it
                const glm::dvec4 wide = glm::dmat4(f.before.layers[i].map_from_world) * p;
                EXPECT_TRUE(wide.x > 0.2 && wide.x < 0.8 && wide.y > 0.2 && wide.y < 0.8);
            }
        const vec3 corner(f.map.map.layers[1].map_from_world * vec4(1, 2, 3, 1));
        const vec4 clip = f.map.clip_from_world[1] * vec4(1, 2, 3, 1),
                   want = shadow::parts::clip_from_world(f.map.map.layers[1]) * vec4(1, 2, 3, 1);
        EXPECT_NEAR(glm::length(clip - want), 0.0f, 1e-4f) << corner.x;
    }
}

TEST_F(Sdsm, ViewsOfNothingAndOfOnePointHaveLayers)
{
    const scene::Scene s = sheets();
    const Fitted nothing = fit(s, view_of(s, {0, 3, 80}, {0, 3, 160}), {.fit = int(Fit::sdsm)});
    EXPECT_TRUE(nothing.samples.empty());
    for (int i = 0; i < 4; ++i) EXPECT_EQ(nothing.map.map.layers[i].map_from_world, nothing.before.layers[i].map_from_world);

    // a speck far off, and nothing else
    scene::Scene far = gpu::floor_scene(0.02f);
    gpu::add_quad(far, {0, 5, 0}, 1e-4f);
    const Fitted speck = fit(far, view_of(far, {0, 1, 0.9f}, {0.012f, 0, 0}, 0.8f), {.fit = int(Fit::sdsm)});
    EXPECT_GE(speck.samples.size(), 1u);
    EXPECT_LT(speck.samples.size(), 200u);
    for (int i = 0; i < 4; ++i) {
        const shaders::LightMapLayer& layer = speck.map.map.layers[i];
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(layer.map_from_world[c][r]));
        EXPECT_GT(layer.far, layer.near);
        EXPECT_GT(layer.texel_metres, 0.0f);
    }
}

TEST_F(Sdsm, IsTheSameInEveryRun)
{
    const scene::Scene s = sheets();
    const scene::View view = view_of(s, {0, 3, 28}, {0, 0, 0});
    const shaders::LightMap first = fit(s, view, {.fit = int(Fit::sdsm)}).map.map;
    for (int run = 0; run < 3; ++run) {
        const shaders::LightMap again = fit(s, view, {.fit = int(Fit::sdsm)}).map.map;
        EXPECT_EQ(memcmp(&first, &again, sizeof first), 0);
    }
}

TEST_F(Sdsm, ConstantsThatLieElsewhereAreRefused)
{
    const shadow::parts::LightMap map{{}, {}, gpu::BufferId{0}};
    struct Wrong {
        float before;
        shaders::LightMap map;
    } wrong{1, {}};
    wrong.map.size = 3;
    EXPECT_THROW(shadow::parts::with_map(wrong, map, 4), std::logic_error);
    wrong.map = map.constants;
    EXPECT_EQ(shadow::parts::with_map(wrong, map, 4).patches.size(), 1u);
    EXPECT_THROW(shadow::parts::with_map(wrong, map, sizeof wrong), std::logic_error);
}

} // namespace
} // namespace gnomon
