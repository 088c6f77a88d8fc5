// SPDX-License-Identifier: Apache-2.0
// Where a light's depth is cut into slices.
#include "techniques/occlusion_textures/slices.h"

#include "shadow/parts/light_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

using namespace techniques::occlusion_textures;

size_t slice_of(const std::vector<Interval>& slices, float depth)
{
    size_t found = slices.size();
    for (size_t s = 0; s < slices.size(); ++s)
        if (depth > slices[s].near && depth <= slices[s].far) found = s;
    return found;
}

TEST(OcclusionTexturesSlices, HoldEveryDepthOfTheContentOnce)
{
    const std::vector<Interval> content{{1, 1}, {1.2f, 1.9f}, {4, 4.01f}, {4, 8}, {7.5f, 9}, {20, 20}};
    for (int placement = 0; placement < 3; ++placement)
        for (int count = 1; count <= SLICES_MAX; ++count) {
            const std::vector<Interval> slices = cut(content, count, placement, true);
            ASSERT_EQ(slices.size(), size_t(count));
            float end = 0;
            for (const Interval& s : slices) {
                if (s.near > s.far) continue; // empty
                EXPECT_GE(s.near, end);
                end = s.far;
            }
            for (const Interval& i : content)
                for (int k = 0; k <= 10; ++k) {
                    const float depth = i.near + (i.far - i.near) * float(k) / 10;
                    EXPECT_LT(slice_of(slices, depth), size_t(count)) << depth << ", " << count << " slices, placement " << placement;
                }
        }
}

TEST(OcclusionTexturesSlices, EndWhereTheirContentEnds)
{
    const std::vector<Interval> slices = cut({{1, 1.5f}, {9, 10}}, 2, PLACE_UNIFORM, false);
    EXPECT_NEAR(slices[0].far, 1.5f, 0.01f) << "and not at 5.5, half-way";
    EXPECT_NEAR(slices[1].near, 9.0f, 0.01f);
    EXPECT_NEAR(slices[1].far, 10.0f, 0.01f);
}

TEST(OcclusionTexturesSlices, LogarithmicOnesGrowByOneFactor)
{
    const std::vector<Interval> slices = cut({{1, 16}}, 4, PLACE_LOGARITHMIC, true);
    for (int s = 0; s < 4; ++s) EXPECT_NEAR(slices[size_t(s)].far, std::exp2(float(s + 1)), 0.01f);
    // under a sun there is no factor: they are even
    const std::vector<Interval> even = cut({{0, 16}}, 4, PLACE_LOGARITHMIC, false);
    for (int s = 0; s < 4; ++s) EXPECT_NEAR(even[size_t(s)].far, 4 * float(s + 1), 0.01f);
}

TEST(OcclusionTexturesSlices, FittedOnesSeparateObjects)
{
    // thin things at five depths that even slices would throw together
    const std::vector<float> depths{1.0f, 1.3f, 1.7f, 2.2f, 20.0f};
    std::vector<Interval> content;
    for (const float d : depths) content.push_back({d, d + 0.02f});
    for (const bool perspective : {false, true}) {
        const std::vector<Interval> slices = cut(content, 5, PLACE_FITTED, perspective);
        // under a sun a bin is 0.15 m wide
        for (size_t i = 0; i < depths.size(); ++i)
            EXPECT_NEAR(slices[slice_of(slices, depths[i] + 0.01f)].far, depths[i] + 0.02f, 0.01f) << depths[i] << ", " << perspective;
    }
    EXPECT_EQ(slice_of(cut(content, 5, PLACE_UNIFORM, true), 1.0f), slice_of(cut(content, 5, PLACE_UNIFORM, true), 2.2f));
}

TEST(OcclusionTexturesSlices, FlatThingsCountAtTheEndsToo)
{
    const float depths[] = {2.5f, 3.3f, 4.0f};
    std::vector<Interval> content;
    for (const float d : depths) content.push_back({d, d});
    const std::vector<Interval> slices = cut(content, 3, PLACE_FITTED, true);
    for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(slices[i].far, depths[i], 0.01f);
}

TEST(OcclusionTexturesSlices, NothingGivesEmptyOnes)
{
    for (const Interval& s : cut({}, 8, PLACE_FITTED, true)) EXPECT_GT(s.near, s.far);
    for (int placement = 0; placement < 3; ++placement) { // one flat sheet: one slice holds it
        const std::vector<Interval> slices = cut({{3, 3}}, 4, placement, true);
        EXPECT_LT(slice_of(slices, 3.0f), 4u) << placement;
        for (const Interval& s : slices) EXPECT_TRUE(std::isfinite(s.near) == std::isfinite(s.far));
    }
}

TEST(OcclusionTexturesSlices, LayersSeeOnlyWhatStandsBeforeThem)
{
    scene::Scene s;
    const scene::Light light = scene::parse_light("point,position=0/0/0,radius=0.1", {}, {vec3(-9), vec3(9)});
    const scene::View view = scene::make_view({.eye = {0, 0, 9}, .target = {0, 0, 0}}, {8, 8}, {vec3(-9), vec3(9)});
    const shaders::LightMap map = shadow::parts::fit_light_map(s, {vec3(-9), vec3(9)}, view, light, {.size = 64});
    const std::vector<Bounds> boxes{{vec3(2, -0.5f, -0.5f), vec3(3, 0.5f, 0.5f)}, {vec3(-1, -5, -1), vec3(1, -4, 1)}};
    const std::vector<Interval> right = depths_in_layer(boxes, map.layers[0], {}), below = depths_in_layer(boxes, map.layers[3], {});
    ASSERT_EQ(right.size(), 1u);
    EXPECT_NEAR(right[0].near, 2, 1e-3);
    EXPECT_NEAR(right[0].far, 3, 1e-3);
    ASSERT_EQ(below.size(), 1u);
    EXPECT_NEAR(below[0].near, 4, 1e-3);
    EXPECT_TRUE(depths_in_layer(boxes, map.layers[1], {}).empty());
    EXPECT_TRUE(depths_in_layer(boxes, map.layers[3], {vec4(0, 1, 0, 0)}).empty()) << "behind a panel that shines upwards";
}

} // namespace
} // namespace gnomon
