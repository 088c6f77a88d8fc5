// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/light.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

Bounds unit_bounds()
{
    Bounds b;
    b.add(vec3(-2, 0, -2));
    b.add(vec3(2, 1, 2));
    return b;
}

Light parse(std::string_view text)
{
    Light sun{"sun", vec3(1, 0.9f, 0.8f), 3.0f, DirectionalLight{glm::normalize(vec3(0, -1, -1)), 0.01f}};
    Light panel{"panel, left", vec3(1), {}, RectLight{{0, 3, 0}, {1, 0, 0}, {0, 0, 0.5f}}};
    return parse_light(text, {sun, panel}, unit_bounds());
}

void expect_near(vec3 a, vec3 b) { EXPECT_LT(glm::length(a - b), 1e-5f) << a.x << " " << a.y << " " << a.z; }

TEST(SceneLightParse, SunAngles)
{
    const auto direction = [](std::string_view text) { return std::get<DirectionalLight>(parse(text).shape).direction; };
    expect_near(direction("directional,elevation=90"), {0, -1, 0});
    expect_near(direction("directional,elevation=0,azimuth=0"), {0, 0, -1}); // it stands at +Z and shines towards -Z
    expect_near(direction("directional,elevation=0,azimuth=90"), {-1, 0, 0});
    expect_near(direction("directional,direction=0/-2/0"), {0, -1, 0});
    EXPECT_NEAR(std::get<DirectionalLight>(parse("directional,angle=0.53").shape).angular_radius, glm::radians(0.265f), 1e-7f);
    EXPECT_EQ(std::get<DirectionalLight>(parse("directional").shape).angular_radius, 0.0f);
}

TEST(SceneLightParse, AKnownNameIsChangedByItsKeysOnly)
{
    const Light sun = parse("sun,elevation=30");
    EXPECT_EQ(sun.intensity, 3.0f);
    EXPECT_EQ(sun.color, vec3(1, 0.9f, 0.8f));
    EXPECT_EQ(std::get<DirectionalLight>(sun.shape).angular_radius, 0.01f);
    expect_near(std::get<DirectionalLight>(sun.shape).direction, {0, -0.5f, -std::sqrt(0.75f)}); // the azimuth stays
    const auto panel = std::get<RectLight>(parse("panel, left,width=4").shape);
    expect_near(panel.half_u, {2, 0, 0});
    expect_near(panel.half_v, {0, 0, 0.5f});
}

TEST(SceneLightParse, PlacedLights)
{
    const auto spot = std::get<SpotLight>(parse("spot,position=1/2/3,target=1/0/3,cone=60,inner=20,radius=0.1").shape);
    expect_near(spot.position, {1, 2, 3});
    expect_near(spot.direction, {0, -1, 0});
    EXPECT_NEAR(spot.outer_angle, glm::radians(30.0f), 1e-6f);
    EXPECT_NEAR(spot.inner_angle, glm::radians(10.0f), 1e-6f);
    EXPECT_EQ(spot.radius, 0.1f);
    EXPECT_EQ(std::get<PointLight>(parse("point,position=0/3/0,radius=0.2").shape).radius, 0.2f);
    const auto rect = std::get<RectLight>(parse("rect,position=0/1/5,target=0/1/0,width=2,height=1").shape);
    expect_near(glm::normalize(glm::cross(rect.half_u, rect.half_v)), {0, 0, -1});
    EXPECT_NEAR(glm::length(rect.half_u), 1.0f, 1e-6f);
    EXPECT_NEAR(rect.half_u.y, 0.0f, 1e-6f);
    const auto down = std::get<RectLight>(parse("rect,position=0/4/0,target=0/0/0,width=2,height=1").shape);
    expect_near(glm::normalize(glm::cross(down.half_u, down.half_v)), {0, -1, 0});
    expect_near(down.half_u, {1, 0, 0});
    expect_near(std::get<DiskLight>(parse("disk,position=5/0/0,target=0/0/0,radius=0.5").shape).normal, {-1, 0, 0});
}

TEST(SceneLightParse, LeftOutPositionsSeeTheScene)
{
    for (const char* text : {"spot", "point", "rect", "disk"}) {
        const Light light = parse(text);
        const vec3 centre = unit_bounds().centre();
        EXPECT_TRUE(reaches(light, centre)) << text;
        EXPECT_GT(light_point(light, centre, vec2(0.5f)).y, unit_bounds().max.y) << text;
        EXPECT_EQ(light.name, text);
    }
    EXPECT_NO_THROW(parse_light("spot", {}, Bounds{}));
}

TEST(SceneLightParse, CommonKeys)
{
    const Light light = parse("point,color=#ff8000,intensity=12.5,name=lamp");
    EXPECT_EQ(light.name, "lamp");
    EXPECT_EQ(light.intensity, 12.5f);
    EXPECT_NEAR(light.color.x, 1.0f, 1e-6f);
    EXPECT_NEAR(light.color.y, 0.21586f, 1e-4f); // sRGB 128
    EXPECT_EQ(light.color.z, 0.0f);
    EXPECT_EQ(parse("point,color=2/0.5/0").color, vec3(2, 0.5f, 0));
}

struct Bad {
    const char *text, *says;
};

TEST(SceneLightParse, ErrorsNameTheFaultAndTheWayOut)
{
    const Bad table[] = {
        {"", "begin with sun"},
        {"elevation=40", "begin with sun"},
        {"spott", "spot"},
        {"panel", "panel, left"},
        {"directional,elevation=100", "-90 to 90 degrees"},
        {"directional,elevation=nan", "finite"},
        {"directional,elevation=inf", "finite"},
        {"directional,elevation=1e99", "finite"},
        {"directional,elevation=", "finite"},
        {"directional,elevation=40x", "finite"},
        {"directional,elevaton=40", "elevation"},
        {"directional,radius=1", "azimuth"},
        {"directional,direction=0/0/0", "same point"},
        {"directional,direction=0/-1/0,elevation=3", "not both"},
        {"spot,cone=0", "0.1 to 179"},
        {"spot,cone=20,inner=40", "wider"},
        {"spot,position=1/2", "three numbers"},
        {"spot,position=1/2/x", "finite"},
        {"spot,position=0/1/0,target=0/1/0", "same point"},
        {"rect,width=0", "outside its range"},
        {"disk,radius=-1", "outside its range"},
        {"point,color=#12345", "hexadecimal"},
        {"point,color=#12345g", "hexadecimal"},
        {"point,color=-1/0/0", "outside its range"},
        {"point,radius=0.1,oops", "key=value"},
    };
    for (const Bad& bad : table) {
        try {
            parse(bad.text);
            FAIL() << "'" << bad.text << "' was accepted";
        } catch (const base::Error& error) {
            EXPECT_NE(std::string(error.what()).find(bad.says), std::string::npos) << bad.text << ": " << error.what();
        }
    }
}

} // namespace
} // namespace gnomon::scene
