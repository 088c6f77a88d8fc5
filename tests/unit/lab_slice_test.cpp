// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/slice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lab {
namespace {

Stage stage(const std::string& light) { return open_stage({"closed_box", {}, "", {light}, {160, 80}}); }

TEST(SlicePlane, HoldsTheLightAndTheScene)
{
    for (const char* light : {"sun,elevation=30,azimuth=70,angle=0", "point,position=3/5/-2", "sun,elevation=90"}) {
        const Stage s = stage(light);
        const Slice slice = make_slice(s, {});
        const vec4 l = scene::light_point(s.lights.front(), slice.centre, vec2(0.5f));
        const vec3 towards = glm::normalize(l.w == 0 ? vec3(l) : vec3(l) - slice.centre), normal = glm::cross(slice.right, slice.up);
        EXPECT_NEAR(glm::dot(towards, normal), 0.0f, 1e-5f) << light;
        EXPECT_NEAR(glm::dot(slice.right, slice.up), 0.0f, 1e-6f);
        for (int i = 0; i < 8; ++i) {
            const vec3 corner(
                i & 1 ? s.bounds.max.x : s.bounds.min.x, i & 2 ? s.bounds.max.y : s.bounds.min.y, i & 4 ? s.bounds.max.z : s.bounds.min.z);
            const vec4 clip = slice.view.clip_from_world * vec4(corner, 1);
            EXPECT_LE(std::abs(clip.x), 1.0f);
            EXPECT_LE(std::abs(clip.y), 1.0f);
            EXPECT_GT(clip.z, 0.0f);
            EXPECT_LT(clip.z, 1.0f);
        }
    }
}

TEST(SlicePlane, IsWhereItIsPut)
{
    const Stage s = stage("sun,elevation=30,azimuth=70");
    const Slice slice = make_slice(s, {.centre = vec3(0.1f, 0.2f, 0.3f), .right = vec3(0, 0, 2), .up = vec3(1, 0, 1), .height = 4});
    EXPECT_NEAR(glm::length(slice.right - vec3(0, 0, 1)), 0, 1e-6);
    EXPECT_NEAR(glm::length(slice.up - vec3(1, 0, 0)), 0, 1e-6);
    // right by 2 m of 4 x 8: half of the way to the picture's edge
    const vec4 clip = slice.view.clip_from_world * vec4(0.1f, 0.2f, 2.3f, 1);
    EXPECT_NEAR(clip.x, 0.5f, 1e-5f);
    EXPECT_NEAR(clip.y, 0.0f, 1e-5f);
    EXPECT_NEAR(clip.z, slice.depth, 1e-6f);
    EXPECT_THROW(make_slice(s, {.right = vec3(0, 1, 0)}), base::Error);
    EXPECT_THROW(make_slice(s, {.right = vec3(0), .up = vec3(0, 1, 0)}), base::Error);
}

TEST(SlicePlane, OutlineIsWhereItCuts)
{
    const Stage s = stage("sun,elevation=30,azimuth=0,angle=0");
    const Slice slice = make_slice(s, {});
    const auto outline = slice_outline(s.scene, slice);
    ASSERT_GT(outline.size(), 4u);
    vec2 low(1e9f), high(-1e9f);
    for (const auto& segment : outline)
        for (const vec2 p : segment) low = glm::min(low, p), high = glm::max(high, p);
    // the box fills 1 / 1.05 of the picture's height or width
    EXPECT_NEAR(std::max((high.x - low.x) / 160.0f, (high.y - low.y) / 80.0f), 1 / 1.05f, 0.01f);
    EXPECT_TRUE(slice_outline(s.scene, make_slice(s, {.centre = vec3(0, 0, 100), .right = vec3(1, 0, 0)})).empty());
}

} // namespace
} // namespace gnomon::lab
