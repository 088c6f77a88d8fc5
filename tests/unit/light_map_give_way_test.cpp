// SPDX-License-Identifier: Apache-2.0
// Where a light map's fit gives way to a plainer one, and what a spot's covers.
#include "scene/view.h"
#include "shadow/parts/fit.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::shadow::parts {
namespace {

constexpr base::Size picture{320, 180};
const Bounds bounds{{-20, 0, -20}, {20, 8, 20}};
const scene::Camera street{"", {0, 2, 18}, {0, 1, 0}, {0, 1, 0}, 0.9f};

shaders::LightMap fitted(Fit fit, const char* light, const scene::Camera& camera = street, shaders::FitParams p = {})
{
    p.fit = int(fit), p.stable = 0;
    const scene::View view = scene::make_view(camera, picture, bounds);
    return fit_light_map({}, bounds, view, scene::parse_light(light, {}, bounds), {.size = 512, .fitting = p});
}

Fit used(Fit fit, const char* light, const scene::Camera& camera = street) { return Fit(fitted(fit, light, camera).fit_used); }

TEST(FitGivesWay, WarpsThatSuitTheViewAreUsed)
{
    for (const Fit fit : {Fit::uniform, Fit::focused, Fit::cascades, Fit::psm, Fit::lispsm, Fit::tsm, Fit::cascades_warped})
        for (const char* light :
            {"sun,elevation=50,azimuth=90", "sun,elevation=90", "sun,elevation=40,azimuth=20"}) // in the view's plane: 90
            EXPECT_EQ(used(fit, light), fit) << light;
    for (const Fit fit : {Fit::psm, Fit::lispsm, Fit::tsm}) EXPECT_EQ(used(fit, "spot,position=16/7/6,target=0/0/4,cone=80"), fit);
}

TEST(FitGivesWay, LightsAlongTheViewHaveNoWarpAcross)
{
    const scene::Camera level{"", {0, 2, 18}, {0, 2, 0}, {0, 1, 0}, 0.9f};
    for (const char* light : {"sun,direction=0/0/-1", "sun,direction=0/0/1", "sun,direction=0.001/0/-1"}) {
        EXPECT_EQ(used(Fit::lispsm, light, level), Fit::focused) << light;
        EXPECT_EQ(used(Fit::cascades_warped, light, level), Fit::cascades) << light;
    }
    EXPECT_EQ(used(Fit::tsm, "sun,direction=0/0/1", level), Fit::focused);
}

TEST(FitGivesWay, ViewsWithoutPerspectiveOrReceiversHaveNoWarp)
{
    const scene::Camera orthographic{"", {4, 3, 8}, {0, 1, 0}, {0, 1, 0}, 0.9f, 2.0f}, away{"", {0, 3, 80}, {0, 3, 160}};
    for (const scene::Camera& camera : {orthographic, away})
        for (const Fit fit : {Fit::psm, Fit::lispsm, Fit::tsm}) {
            EXPECT_EQ(used(fit, "sun,elevation=50,azimuth=90", camera), Fit::focused);
            EXPECT_EQ(used(fit, "spot,position=16/7/6,target=0/0/4,cone=80", camera), Fit::focused);
        }
    EXPECT_EQ(used(Fit::cascades_warped, "sun,elevation=50,azimuth=90", orthographic), Fit::cascades);
}

TEST(FitGivesWay, TexelsThatWouldDifferTenThousandfoldAreNotDrawn)
{
    scene::Camera close = street;
    close.near = 1e-4f;
    const scene::View view = scene::make_view(close, picture, bounds);
    const auto psm = [&](float slide) {
        return fit_light_map({}, bounds, view, scene::parse_light("sun,elevation=50,azimuth=90", {}, bounds),
            {.size = 512, .fitting = {.fit = int(Fit::psm), .psm_slide = slide}});
    };
    EXPECT_EQ(Fit(psm(0.0f).fit_used), Fit::focused);
    EXPECT_EQ(Fit(psm(0.05f).fit_used), Fit::psm);
}

TEST(FitGivesWay, CubesKnowNoFit)
{
    for (const char* light : {"point,position=0/3/0", "spot,position=0/6/0,target=0/0/0,cone=150", "rect,position=0/6/0,target=0/0/0"})
        for (const Fit fit : {Fit::focused, Fit::psm, Fit::lispsm, Fit::tsm, Fit::cascades_warped}) {
            const shaders::LightMap map = fitted(fit, light), plain = fitted(Fit::uniform, light);
            ASSERT_EQ(map.layer_count, 6u);
            for (int face = 0; face < 6; ++face) EXPECT_EQ(map.layers[face].map_from_world, plain.layers[face].map_from_world);
            EXPECT_EQ(map.fit_used, int(fit));
        }
}

TEST(FitGivesWay, UnwarpedFitsAreThoseBeneath)
{
    const auto plain = [](Fit fit) { return Fit(unwarped({.fit = int(fit)}).fit); };
    for (const Fit fit : {Fit::uniform, Fit::focused, Fit::cascades}) EXPECT_EQ(plain(fit), fit);
    for (const Fit fit : {Fit::psm, Fit::lispsm, Fit::tsm}) EXPECT_EQ(plain(fit), Fit::focused);
    EXPECT_EQ(plain(Fit::cascades_warped), Fit::cascades);
}

TEST(SpotFit, HasNoCascades)
{
    const char* light = "spot,position=16/7/6,target=0/0/4,cone=80";
    const auto same = [&](Fit a, Fit b) { return fitted(a, light).layers[0].map_from_world == fitted(b, light).layers[0].map_from_world; };
    EXPECT_TRUE(same(Fit::cascades, Fit::focused));
    EXPECT_TRUE(same(Fit::sdsm, Fit::focused));
    EXPECT_TRUE(same(Fit::cascades_warped, Fit::lispsm));
    EXPECT_FALSE(same(Fit::lispsm, Fit::focused));
}

TEST(SpotFit, CoversWhatTheViewSeesOfTheCone)
{
    const char* light = "spot,position=0/7.5/0,target=0/0/0,cone=110";
    const shaders::LightMapLayer all = fitted(Fit::uniform, light).layers[0];
    const scene::Camera close{"", {4, 1.5f, 3}, {3, 0, 0}, {0, 1, 0}, 0.5f};
    const shaders::LightMapLayer seen = fitted(Fit::focused, light, close).layers[0];
    EXPECT_LT(seen.texel_metres, 0.5f * all.texel_metres);
    // a view of all of it changes nothing
    const scene::Camera above{"", {0, 60, 0.1f}, {0, 0, 0}, {0, 1, 0}, 1.0f};
    EXPECT_EQ(fitted(Fit::focused, light, above).layers[0].texel_metres, all.texel_metres);
}

TEST(SpotFit, WarpsHaveSmallerTexelsNearTheEye)
{
    const char* light = "spot,position=19/7/0,target=0/0/0,cone=115";
    const vec3 near_the_eye(0.5f, 0, 15);
    const shaders::LightMapLayer focused = fitted(Fit::focused, light).layers[0];
    for (const Fit fit : {Fit::psm, Fit::lispsm, Fit::tsm}) {
        const shaders::LightMapLayer layer = fitted(fit, light).layers[0];
        ASSERT_EQ(layer.warped, 1u);
        const glm::dvec2 before = tests::project(focused, near_the_eye).texel, after = tests::project(layer, near_the_eye).texel;
        EXPECT_LT(after.x * after.y, 0.5 * before.x * before.y) << int(fit);
    }
}

// What is nearest may be coarser, and what is further finer.
TEST(WarpParameters, MoveTexelsFromNearToFar)
{
    const vec3 close(0, 0.1f, 16.5f), distant(0, 0.1f, -15);
    const auto area = [](const shaders::LightMap& map, vec3 p) {
        const glm::dvec2 t = tests::project(map.layers[0], p).texel;
        return t.x * t.y;
    };
    const char* light = "sun,elevation=50,azimuth=90";
    const shaders::LightMap lispsm = fitted(Fit::lispsm, light), later = fitted(Fit::lispsm, light, street, {.warp_near = 0.2f});
    EXPECT_GT(area(later, close), 1.1 * area(lispsm, close));
    EXPECT_LT(area(later, distant), 0.9 * area(lispsm, distant));
    const shaders::LightMap psm = fitted(Fit::psm, light), slid = fitted(Fit::psm, light, street, {.psm_slide = 0.3f});
    EXPECT_GT(area(slid, close), 1.1 * area(psm, close));
    EXPECT_LT(area(slid, distant), 0.9 * area(psm, distant));
}

} // namespace
} // namespace gnomon::shadow::parts
