// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

Bounds box(vec3 min, vec3 max)
{
    Bounds b;
    b.add(min);
    b.add(max);
    return b;
}

vec3 project(const View& view, vec3 p)
{
    const vec4 clip = view.clip_from_world * vec4(p, 1.0f);
    return vec3(clip) / clip.w;
}

vec2 to_pixel(const View& view, vec3 ndc) { return (vec2(ndc) * 0.5f + 0.5f) * vec2(float(view.size.width), float(view.size.height)); }

Camera camera_at(vec3 eye, vec3 target)
{
    Camera c;
    c.eye = eye, c.target = target;
    return c;
}

TEST(SceneView, UpAndRightOnScreen)
{
    const View view = make_view(camera_at({0, 1, 5}, {0, 1, 0}), {200, 100}, box(vec3(-3), vec3(3)));
    EXPECT_NEAR(project(view, {0, 1, 0}).x, 0.0f, 1e-6f);
    EXPECT_LT(project(view, {0, 2, 0}).y, 0.0f); // Vulkan's y points down
    EXPECT_GT(project(view, {1, 1, 0}).x, 0.0f);
    // The full vertical angle reaches the picture's top edge.
    const float top = 5.0f * std::tan(0.5f * Camera{}.fov_y);
    EXPECT_NEAR(project(view, {0, 1 + top, 0}).y, -1.0f, 1e-5f);
    EXPECT_NEAR(project(view, {2 * top, 1, 0}).x, 1.0f, 1e-5f);
}

TEST(SceneView, DepthIsReversedAndInfinite)
{
    Camera c = camera_at({0, 0, 5}, {0, 0, 0});
    c.near = 0.25f;
    const View view = make_view(c, {64, 64}, box(vec3(-3), vec3(3)));
    EXPECT_EQ(view.near, 0.25f);
    EXPECT_NEAR(project(view, {0, 0, 4.75f}).z, 1.0f, 1e-6f);
    EXPECT_NEAR(project(view, {0, 0, 0}).z, 0.05f, 1e-7f); // near / distance
    const float far = project(view, {0, 0, -1e6f}).z;
    EXPECT_GT(far, 0.0f);
    EXPECT_LT(far, 1e-6f);
}

TEST(SceneView, OrthographicDepthCoversTheScene)
{
    Camera c = camera_at({0, 0, 10}, {0, 0, 0});
    c.half_height = 2.0f;
    const Bounds bounds = box(vec3(-3), vec3(3));
    const View view = make_view(c, {200, 100}, bounds);
    EXPECT_TRUE(view.orthographic);
    EXPECT_NEAR(project(view, {0, 2, 0}).y, -1.0f, 1e-6f);
    EXPECT_NEAR(project(view, {4, 0, 0}).x, 1.0f, 1e-6f);
    const float front = project(view, {0, 0, 3}).z, back = project(view, {0, 0, -3}).z;
    EXPECT_LE(front, 1.0f);
    EXPECT_GT(front, 0.95f);
    EXPECT_GT(back, 0.0f); // 0 is background
    EXPECT_LT(back, 0.05f);
}

TEST(SceneView, RaysGoThroughWhatTheyProject)
{
    Camera ortho = camera_at({3, 4, 6}, {0, 1, 0});
    ortho.half_height = 3.0f;
    const Bounds bounds = box(vec3(-5), vec3(5));
    for (const Camera& c : {camera_at({3, 4, 6}, {0, 1, 0}), ortho}) {
        for (vec2 jitter : {vec2(0), vec2(0.3f, -0.4f)}) {
            const View view = make_view(c, {257, 129}, bounds, jitter);
            for (vec2 pixel : {vec2(0.5f, 0.5f), vec2(200.5f, 17.25f), vec2(128.5f, 64.5f)}) {
                const Ray ray = view_ray(view, pixel);
                EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-6f);
                const vec2 back = to_pixel(view, project(view, ray.origin + 7.0f * ray.direction));
                EXPECT_NEAR(back.x, pixel.x, 2e-3f);
                EXPECT_NEAR(back.y, pixel.y, 2e-3f);
            }
        }
    }
}

TEST(SceneView, JitterMovesThePictureRightAndDown)
{
    const Bounds bounds = box(vec3(-5), vec3(5));
    const Camera c = camera_at({3, 4, 6}, {0, 1, 0});
    const vec3 p(0.4f, 0.8f, -0.3f);
    const View still = make_view(c, {640, 360}, bounds), moved = make_view(c, {640, 360}, bounds, vec2(0.5f, 0.25f));
    const vec2 step = to_pixel(moved, project(moved, p)) - to_pixel(still, project(still, p));
    EXPECT_NEAR(step.x, 0.5f, 1e-3f);
    EXPECT_NEAR(step.y, 0.25f, 1e-3f);
}

TEST(SceneView, WorldFromClipUndoesTheProjection)
{
    const View view = make_view(camera_at({30, 4, 6}, {0, 1, 0}), {640, 360}, box(vec3(-50), vec3(50)));
    for (vec3 p : {vec3(1, 2, 3), vec3(-20, 5, -9)}) {
        const vec4 clip = view.clip_from_world * vec4(p, 1.0f);
        const vec4 world = view.world_from_clip * clip;
        EXPECT_LT(glm::length(vec3(world) / world.w - p), 1e-3f);
    }
}

TEST(SceneView, ChosenNearStaysBetweenEyeAndTarget)
{
    const Bounds large = box(vec3(-1000), vec3(1000));
    EXPECT_NEAR(make_view(camera_at({0, 0, 500}, {0, 0, 0}), {8, 8}, large).near, 1e-3f * large.radius(), 1e-3f);
    EXPECT_LE(make_view(camera_at({0, 0, 0.1f}, {0, 0, 0}), {8, 8}, large).near, 0.01f); // a macro shot
    EXPECT_GT(make_view(camera_at({0, 0, 1}, {0, 0, 0}), {8, 8}, Bounds{}).near, 0.0f);
}

TEST(SceneView, LooksStraightDown)
{
    const View view = make_view(camera_at({0, 10, 0}, {0, 0, 0}), {64, 64}, box(vec3(-3), vec3(3)));
    const vec3 ndc = project(view, {0, 0, 0});
    EXPECT_NEAR(ndc.x, 0.0f, 1e-5f);
    EXPECT_GT(project(view, {1, 0, 0}).x, 0.1f);
}

TEST(SceneView, RefusesCamerasThatSeeNothing)
{
    const Bounds bounds = box(vec3(-1), vec3(1));
    EXPECT_THROW(make_view(camera_at(vec3(1), vec3(1)), {8, 8}, bounds), base::Error);
    EXPECT_THROW(make_view(camera_at(vec3(NAN), vec3(1)), {8, 8}, bounds), base::Error);
    EXPECT_THROW(make_view(camera_at(vec3(2), vec3(1)), {0, 8}, bounds), base::Error);
    Camera wide = camera_at(vec3(2), vec3(1));
    wide.fov_y = 4.0f;
    EXPECT_THROW(make_view(wide, {8, 8}, bounds), base::Error);
    wide.fov_y = 1.0f, wide.near = -1.0f;
    EXPECT_THROW(make_view(wide, {8, 8}, bounds), base::Error);
}

TEST(SceneView, FitSeesAllOfTheBounds)
{
    for (const Bounds& b :
        {box(vec3(-1), vec3(1)), box({-50, 0, -2}, {50, 1, 2}), box({-1, 0, -1}, {1, 40, 1}), box({-3, 0, -3}, {3, 0, 3})}) {
        const View view = make_view(fit_camera(b), {300, 200}, b);
        float extent = 0.0f;
        for (int i = 0; i < 8; ++i) {
            const vec3 ndc = project(view, {i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z});
            extent = std::max({extent, std::abs(ndc.x), std::abs(ndc.y)});
            EXPECT_GT(ndc.z, 0.0f);
            EXPECT_LT(ndc.z, 1.0f);
        }
        EXPECT_LE(extent, 1.0f);
        EXPECT_GT(extent, 0.7f); // and fills the picture
    }
    EXPECT_NO_THROW(make_view(fit_camera(Bounds{}), {8, 8}, Bounds{}));
    EXPECT_NO_THROW(make_view(fit_camera(box(vec3(2), vec3(2))), {8, 8}, box(vec3(2), vec3(2))));
}

TEST(SceneView, ParseCamera)
{
    Camera nave = camera_at({1, 2, 3}, {0, 0, 0}), yard = camera_at({4, 5, 6}, {0, 0, 0});
    nave.name = "nave, centre line", yard.name = "yard";
    Camera yard_top = yard;
    yard_top.name = "yard from above";
    const std::vector<Camera> known = {nave, yard, yard_top};
    const Bounds b = box(vec3(-1), vec3(1));
    EXPECT_EQ(parse_camera("nave, centre line", known, b).eye, vec3(1, 2, 3));
    EXPECT_EQ(parse_camera("nave", known, b).name, "nave, centre line");
    EXPECT_EQ(parse_camera("yard", known, b).name, "yard"); // the full name wins over being a part of two
    EXPECT_NEAR(parse_camera("nave,fov=90", known, b).fov_y, glm::radians(90.0f), 1e-6f);
    EXPECT_EQ(parse_camera("fit,ortho=5", known, b).half_height, 5.0f);
    const Camera free = parse_camera("eye=1/2/3,target=0/1/0,up=1/0/0,near=0.5", known, b);
    EXPECT_EQ(free.eye, vec3(1, 2, 3));
    EXPECT_EQ(free.target, vec3(0, 1, 0));
    EXPECT_EQ(free.up, vec3(1, 0, 0));
    EXPECT_EQ(free.near, 0.5f);
    struct Bad {
        const char *text, *says;
    };
    for (const Bad& bad :
        {Bad{"", "missing"}, {"yart", "yard"}, {"ya", "in full"}, {"fit,fov=0", "1 to 170"}, {"fit,eye=0/0", "three numbers"},
            {"fit,fow=3", "fov"}, {"eye=0/0/0,target=0/0/0", "same point"}, {"fit,near=nan", "finite"}}) {
        try {
            parse_camera(bad.text, known, b);
            FAIL() << "'" << bad.text << "' was accepted";
        } catch (const base::Error& error) {
            EXPECT_NE(std::string(error.what()).find(bad.says), std::string::npos) << bad.text << ": " << error.what();
        }
    }
}

} // namespace
} // namespace gnomon::scene
