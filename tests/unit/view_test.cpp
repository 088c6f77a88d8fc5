// SPDX-License-Identifier: Apache-2.0
#include "apps/view/controls.h"
#include "apps/view/text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::view {
namespace {

const Bounds bounds{vec3(-3, 0, -3), vec3(3, 4, 3)};

/// What its text is read back as.
scene::Camera again(const scene::Camera& camera) { return scene::parse_camera(camera_text(camera), {}, bounds); }
scene::Light again(const scene::Light& light)
{
    return scene::parse_light(light_text(light, {std::string(scene::kind_name(light.kind())), {}, false}), {}, bounds);
}

void expect_same_camera(const scene::Camera& a, const scene::Camera& b)
{
    EXPECT_EQ(a.eye, b.eye);
    EXPECT_EQ(a.target, b.target);
    EXPECT_EQ(a.up, b.up);
    EXPECT_EQ(a.half_height, b.half_height);
    EXPECT_EQ(a.near, b.near);
    if (a.half_height <= 0.0f) {
        EXPECT_EQ(a.fov_y, b.fov_y);
    }
}

TEST(ViewText, CamerasComeBackBitByBit)
{
    scene::Camera camera{"", {1.0f / 3.0f, -2.7e-6f, 1e5f / 7.0f}, {0.1f, 0.2f, 0.3f}, {0, 1, 0}, glm::radians(47.3f)};
    expect_same_camera(again(camera), camera);
    camera.up = {0.0f, 0.6f, 0.8f}, camera.near = 0.013f;
    expect_same_camera(again(camera), camera);
    camera.half_height = 5.1f;
    expect_same_camera(again(camera), camera);
}

TEST(ViewText, LightsSettleOnWhatTheirTextSays)
{
    for (const char* text : {"sun,elevation=33,azimuth=71,angle=0.53", "spot,position=1/2/3,cone=61,inner=17,radius=0.13",
             "point,position=0.1/0.7/-3,radius=0.2", "rect,position=2/3/1,width=1.3,height=0.7,color=0.9/0.5/0.1",
             "disk,radius=0.3,intensity=7"}) {
        const scene::Light given = scene::parse_light(text, {}, bounds), first = again(given), second = again(first);
        ASSERT_EQ(given.kind(), first.kind());
        EXPECT_EQ(given.color, first.color) << text;
        EXPECT_EQ(given.intensity, first.intensity) << text;
        EXPECT_EQ(given.soft(), first.soft()) << text;
        for (const vec2 u : {vec2(0.1f, 0.2f), vec2(0.9f, 0.6f)}) {
            const vec3 p(0.5f, 0.1f, -0.2f);
            EXPECT_LT(glm::distance(scene::light_point(given, p, u), scene::light_point(first, p, u)), 1e-5f) << text;
            EXPECT_LT(glm::distance(scene::light_point(first, p, u), scene::light_point(second, p, u)), 1e-5f) << text;
        }
    }
}

TEST(ViewText, ALightOfTheSceneKeepsItsNameAndItsTurn)
{
    scene::Light lamp{"lamp, left", vec3(1), std::nullopt, scene::RectLight{{0, 3, 0}, {0.6f, 0, 0.8f}, {-0.8f, 0, 0.6f}}};
    const LightOrigin origin = light_origin(lamp, {lamp}, bounds);
    EXPECT_TRUE(origin.known);
    auto& shape = std::get<scene::RectLight>(lamp.shape);
    const vec3 turn = shape.half_u;
    shape.centre = {1, 2, 3};
    const scene::Light read = scene::parse_light(light_text(lamp, origin), {lamp}, bounds);
    EXPECT_EQ(std::get<scene::RectLight>(read.shape).centre, vec3(1, 2, 3));
    EXPECT_LT(glm::distance(std::get<scene::RectLight>(read.shape).half_u, turn), 1e-6f);
    lamp.name = "a=b"; // no option can say it
    EXPECT_FALSE(light_origin(lamp, {lamp}, bounds).known);
}

TEST(ViewText, WordsAreQuotedForTheShell)
{
    EXPECT_EQ(shell_word("eye=1/2/3,fov=50"), "eye=1/2/3,fov=50");
    EXPECT_EQ(shell_word("a b"), "'a b'");
    EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("$(x)"), "'$(x)'");
}

TEST(ViewText, TheCommandNamesWhatDiffersFromTheDefaults)
{
    const lab::Choice choice = lab::parse_choice("shadow_map:pcf=5:bias_scale=2");
    EXPECT_EQ(render_command({"my scene.glb", {}, "fit", {"point,position=0/1/2"}, {64, 48}, 0.5f, 0.45f}, choice),
        "gnomon render 'my scene.glb' --camera fit --light point,position=0/1/2 --size 64x48 --technique shadow_map --shadow_map.pcf 5 "
        "--shadow_map.bias_scale 2 --exposure 0.5");
}

TEST(ViewControls, OrbitKeepsTheDistanceAndStopsBeforeThePole)
{
    const scene::Camera camera{"", {0, 1, 5}, {0, 1, 0}};
    const scene::Camera turned = orbit(camera, {0.3f, 0.2f});
    EXPECT_EQ(turned.target, camera.target);
    EXPECT_NEAR(glm::distance(turned.eye, turned.target), 5.0f, 1e-5f);
    EXPECT_GT(turned.eye.y, 1.5f) << "the mouse moves down: the scene is seen from higher up";
    EXPECT_LT(turned.eye.x, -0.5f) << "the scene follows the mouse to the right";
    const scene::Camera top = orbit(camera, {0, 10});
    EXPECT_NEAR(top.eye.y - 1.0f, 5.0f * std::sin(glm::radians(85.0f)), 1e-4f);
    // A camera above the pole that the limit keeps others from stays usable.
    const scene::Camera above = orbit({"", {0, 5, 0}, {0, 0, 0}}, {0.1f, -0.2f});
    EXPECT_TRUE(std::isfinite(above.eye.x + above.eye.y + above.eye.z));
    EXPECT_NEAR(glm::length(above.eye), 5.0f, 1e-4f);
}

TEST(ViewControls, FlyingAndLookingKeepTheOtherEnd)
{
    const scene::Camera camera{"", {0, 1, 5}, {0, 1, 0}};
    EXPECT_EQ(fly(camera, {0, 0, 2}).eye, vec3(0, 1, 3));
    EXPECT_EQ(fly(camera, {1, 0, 0}).target, vec3(1, 1, 0));
    const scene::Camera looked = look(camera, {0.2f, 0});
    EXPECT_EQ(looked.eye, camera.eye);
    EXPECT_GT(looked.target.x, 0.5f);
    EXPECT_NEAR(glm::distance(approach(camera, 1).eye, camera.target), 4.5f, 1e-5f);
}

TEST(ViewControls, ALightFollowsTheMouse)
{
    const scene::Camera camera{"", {0, 1, 5}, {0, 1, 0}};
    const scene::Light lamp{"", vec3(1), std::nullopt, scene::PointLight{{0, 1, 0}, 0.1f}};
    const auto position = [](const scene::Light& l) { return std::get<scene::PointLight>(l.shape).position; };
    const float half = 5.0f * std::tan(0.5f * camera.fov_y);
    EXPECT_LT(glm::distance(position(drag_light(lamp, camera, {50, 0}, 100, false)), vec3(half, 1, 0)), 1e-4f)
        << "half a height to the right";
    EXPECT_LT(position(drag_light(lamp, camera, {0, -10}, 100, true)).z, -0.1f);
    const scene::Light sun{"", vec3(1), std::nullopt, scene::DirectionalLight{glm::normalize(vec3(0, -1, -1)), 0}};
    const vec3 higher = std::get<scene::DirectionalLight>(drag_light(sun, camera, {0, -10}, 100, false).shape).direction;
    EXPECT_LT(higher.y, -0.75f) << "up: the sun rises";
    EXPECT_NEAR(glm::length(higher), 1.0f, 1e-6f);
}

TEST(ViewText, ColoursOfTheScenesLightsAreSaidWhereTheyDiffer)
{
    scene::Light own;
    own.name = "lamp", own.color = {0.8f, 0.5f, 0.2f}, own.shape = scene::PointLight{};
    const std::vector<scene::Light> known = {own};
    const LightOrigin origin = light_origin("lamp", known);
    EXPECT_EQ(light_text(own, origin).find("color"), std::string::npos);
    scene::Light changed = own;
    changed.color = {0.1f, 0.5f, 0.2f}, changed.intensity = 3.5f;
    const scene::Light read = scene::parse_light(light_text(changed, origin), known, bounds);
    EXPECT_EQ(read.color, changed.color);
    EXPECT_EQ(read.intensity, changed.intensity);
}

TEST(ViewControls, LightsGrowFromPointsAndShrinkBackToThem)
{
    for (const char* text : {"sun,elevation=33,azimuth=71,angle=0", "spot,position=1/2/3,radius=0", "point,position=0.1/0.7/-3,radius=0"}) {
        const scene::Light point = scene::parse_light(text, {}, bounds), grown = resize_light(point, 50, 0.01f);
        EXPECT_FALSE(resize_light(point, -50, 0.01f).soft() && !point.soft()) << text;
        const auto size = [](const scene::Light& l) {
            return glm::distance(
                vec3(scene::light_point(l, {0, 0, 0}, {0.01f, 0.3f})), vec3(scene::light_point(l, {0, 0, 0}, {0.99f, 0.7f})));
        };
        EXPECT_EQ(size(point), 0.0f) << text;
        EXPECT_GT(size(grown), 0.0f) << text;
        EXPECT_GT(size(resize_light(grown, 50, 0.01f)), 1.4f * size(grown)) << text;
        EXPECT_EQ(size(resize_light(grown, -500, 0.01f)), 0.0f) << text;
    }
    for (const char* text : {"rect,position=0/3/0,width=1.5,height=0.5", "disk,position=0/3/0,radius=0.3"}) {
        const scene::Light panel = scene::parse_light(text, {}, bounds), least = resize_light(panel, -1e4f, 0.01f);
        EXPECT_NO_THROW(again(least)) << text << ": panels keep an area";
        const float area
            = glm::distance(vec3(scene::light_point(least, {0, 0, 0}, {0, 0})), vec3(scene::light_point(least, {0, 0, 0}, {1, 1})));
        EXPECT_GT(area, 0.0f) << text;
    }
}

} // namespace
} // namespace gnomon::view
