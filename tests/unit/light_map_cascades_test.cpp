// SPDX-License-Identifier: Apache-2.0
#include "scene/view.h"
#include "shadow/parts/fit.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gnomon::shadow::parts {
namespace {

const Bounds bounds{{-20, 0, -20}, {20, 8, 20}};
constexpr base::Size picture{320, 180};

shaders::LightMap cascades(const scene::View& view, int count, float split, int stable)
{
    return fit_light_map({}, bounds, view, scene::parse_light("sun,elevation=40,azimuth=70", {}, bounds),
        {.size = 512, .fitting = {.fit = int(Fit::cascades), .cascades = count, .split = split, .stable = stable}});
}

TEST(Cascades, EndsAreOfOneLengthOrOfOneRatio)
{
    const std::vector<float> even = cascade_ends(1, 81, 4, 0), ratio = cascade_ends(1, 81, 4, 1), half = cascade_ends(1, 81, 4, 0.5f);
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(even[size_t(i)], 1 + 20 * (i + 1), 1e-4);
        EXPECT_NEAR(ratio[size_t(i)], std::pow(3.0, i + 1), 1e-3);
        EXPECT_NEAR(half[size_t(i)], 0.5f * (even[size_t(i)] + ratio[size_t(i)]), 1e-4);
    }
}

TEST(Cascades, OneRatioCountsFromWhereThereIsSomethingToSee)
{
    const std::vector<float> ends = cascade_ends(1, 160, 4, 1, 10);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(ends[size_t(i)], 10 * std::pow(2.0, i + 1), 1e-3);
    EXPECT_EQ(cascade_ends(1, 160, 4, 1, 0.5f), cascade_ends(1, 160, 4, 1)) << "nearer than the near plane";
    EXPECT_EQ(cascade_ends(1, 160, 4, 0, 10), cascade_ends(1, 160, 4, 0)) << "even ones";
    for (const float end : cascade_ends(1, 160, 4, 0.5f, 1000)) EXPECT_TRUE(end > 1 && end <= 160);
}

// A filter of the guard's radius at any receiver reads its own layer, in the band before the layer too.
TEST(Cascades, LayersHoldTheirBandAndTheFiltersRadius)
{
    const scene::View view = scene::make_view({"", {0, 2, 19}, {0, 1, 0}, {0, 1, 0}, 0.8f}, picture, bounds);
    const float guard = 12;
    for (const int stable : {0, 1}) {
        const shaders::LightMap map = fit_light_map({}, bounds, view, scene::parse_light("sun,elevation=40,azimuth=70", {}, bounds),
            {.size = 256, .fitting = {.fit = int(Fit::cascades), .stable = stable, .blend = 0.4f}, .guard_texels = guard + 1});
        std::mt19937 random(5);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        int in_bands = 0;
        for (int i = 0; i < 20000; ++i) {
            const vec3 p = bounds.min + (bounds.max - bounds.min) * vec3(unit(random), unit(random), unit(random));
            const vec4 clip = view.clip_from_world * vec4(p, 1);
            if (clip.w <= view.near || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            const int layer = tests::select_layer(map, p);
            const double next = tests::next_share(map, p);
            in_bands += next > 0.0;
            for (int k = 0; k < (next > 0.0 ? 2 : 1); ++k) {
                const glm::dvec2 texel = tests::project(map.layers[layer + k], p).uv * 256.0;
                EXPECT_GE(std::min(texel.x, texel.y), double(guard) - 0.01) << stable << layer << k;
                EXPECT_LE(std::max(texel.x, texel.y), 256.0 - double(guard) + 0.01) << stable << layer << k;
            }
        }
        EXPECT_GT(in_bands, 200);
    }
}

TEST(Cascades, NearerLayersHaveSmallerTexels)
{
    const scene::View view = scene::make_view({"", {0, 2, 19}, {0, 1, 0}, {0, 1, 0}, 0.8f}, picture, bounds);
    for (const int stable : {0, 1}) {
        const shaders::LightMap map = cascades(view, 4, 0.75f, stable);
        ASSERT_EQ(map.layer_count, 4u);
        for (int i = 1; i < 4; ++i) EXPECT_GT(map.layers[i].texel_metres, 1.2f * map.layers[i - 1].texel_metres) << stable;
    }
    EXPECT_EQ(cascades(view, 1, 0.75f, 0).layer_count, 1u);
}

// A dolly, a pan and a tilt, 64 steps of a fraction of the finest texel.
TEST(Cascades, StableLayersMoveByWholeTexels)
{
    const scene::View first = scene::make_view({"", {3, 2, 12}, {0, 1, 0}, {0, 1, 0}, 0.8f}, picture, bounds);
    const shaders::LightMap before = cascades(first, 4, 0.75f, 1);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    const float texel = before.layers[0].texel_metres;
    for (int step = 1; step <= 64; ++step) {
        const float t = float(step);
        const vec3 eye(3 + 0.31f * texel * t, 2 + 0.11f * texel * t, 12 - 0.53f * texel * t);
        const scene::View view = scene::make_view({"", eye, {0.01f * t, 1 + 0.004f * t, 0}, {0, 1, 0}, 0.8f}, picture, bounds);
        const shaders::LightMap map = cascades(view, 4, 0.75f, 1);
        for (int layer = 0; layer < 4; ++layer) {
            EXPECT_EQ(map.layers[layer].texel_metres, before.layers[layer].texel_metres);
            EXPECT_EQ(map.layers[layer].near, before.layers[layer].near);
            EXPECT_EQ(map.layers[layer].far, before.layers[layer].far);
            for (int i = 0; i < 8; ++i) {
                const vec3 p(20 * unit(random), 4 + 4 * unit(random), 20 * unit(random));
                const glm::dvec2 moved = (tests::project(map.layers[layer], p).uv - tests::project(before.layers[layer], p).uv) * 512.0;
                EXPECT_NEAR(moved.x, std::round(moved.x), 2e-3) << "step " << step << ", layer " << layer;
                EXPECT_NEAR(moved.y, std::round(moved.y), 2e-3) << "step " << step << ", layer " << layer;
            }
        }
    }
}

} // namespace
} // namespace gnomon::shadow::parts
