// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/motion.h"

#include <gtest/gtest.h>

using namespace gnomon;
using lab::Motion;

namespace {

void expect_near(vec3 a, vec3 b)
{
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-5f) << i;
}

/// The error's text.
std::string refused(const std::string& text)
{
    try {
        lab::parse_motion(text);
    } catch (const base::Error& e) {
        return e.what();
    }
    return "accepted";
}

const scene::Camera camera{"", {0, 2, 5}, {0, 2, 0}};

} // namespace

TEST(Motion, reads_what_it_writes)
{
    for (const char* text : {"still,frames=8", "camera,right=0.05,up=-0.1,forward=2,turn=1,tilt=-0.5,frames=12", "light,azimuth=1,frames=3",
             "light,x=0.1,z=-2,frames=64", "time,step=0.0333,frames=8"})
        EXPECT_EQ(lab::motion_text(lab::parse_motion(text)), text);
    EXPECT_EQ(lab::parse_motion("camera").frames, 8);
}

TEST(Motion, refuses_in_sentences)
{
    const std::pair<const char*, std::vector<const char*>> cases[] = {{"", {"begins with no kind", "still, camera, light or time"}},
        {"camra", {"unknown kind 'camra'", "'camera'"}}, {"camera,rigth=1", {"unknown key 'rigth'", "'right'"}},
        {"camera,step=1", {"unknown key 'step'"}}, {"still,right=1", {"unknown key 'right'"}},
        {"camera,frames=2", {"outside its range 3 to 64"}}, {"camera,frames=65", {"outside its range 3 to 64"}},
        {"camera,frames=4.5", {"no whole number"}}, {"camera,right=x", {"no finite number"}}, {"camera,right=inf", {"no finite number"}},
        {"camera,turn=91", {"range -90 to 90 degrees"}}, {"time,step=0", {"outside its range"}},
        {"light,x=1,azimuth=2", {"give one of the two"}}, {"camera,right=1,fast", {"no key=value pair"}}};
    for (const auto& [text, words] : cases)
        for (const char* word : words) EXPECT_NE(refused(text).find(word), std::string::npos) << text << ": " << refused(text);
}

TEST(Motion, moves_the_camera_along_its_own_axes)
{
    const scene::Camera walked = lab::moved(camera, lab::parse_motion("camera,right=1,up=2,forward=3"), 2);
    expect_near(walked.eye, {2, 6, -1});
    expect_near(walked.target - walked.eye, {0, 0, -5});
    const scene::Camera turned = lab::moved(camera, lab::parse_motion("camera,turn=45"), 2);
    expect_near(turned.eye, camera.eye);
    expect_near(turned.target - turned.eye, {5, 0, 0});
    const scene::Camera tilted = lab::moved(camera, lab::parse_motion("camera,tilt=30"), 3);
    expect_near(tilted.target - tilted.eye, {0, 5, 0});
    expect_near(tilted.up, {0, 0, 1});
    expect_near(lab::moved(camera, lab::parse_motion("still"), 5).eye, camera.eye);
}

TEST(Motion, moves_lights)
{
    const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
    const scene::Light sun = scene::parse_light("sun,elevation=40,azimuth=120", {}, bounds);
    const scene::Light later = lab::moved(sun, lab::parse_motion("light,azimuth=10,elevation=-5"), 2);
    const scene::Light wanted = scene::parse_light("sun,elevation=30,azimuth=140", {}, bounds);
    expect_near(std::get<scene::DirectionalLight>(later.shape).direction, std::get<scene::DirectionalLight>(wanted.shape).direction);
    const scene::Light rect = scene::parse_light("rect,position=1/2/3", {}, bounds);
    expect_near(std::get<scene::RectLight>(lab::moved(rect, lab::parse_motion("light,y=0.5"), 4).shape).centre, {1, 4, 3});
}

TEST(Motion, chooses_steps_where_none_is_given)
{
    const Bounds bounds{{-1, -1, -1}, {1, 1, 1}};
    const scene::Light sun = scene::parse_light("sun", {}, bounds), point = scene::parse_light("point", {}, bounds);
    const auto text = [](const char* motion, const scene::Light& light) {
        return lab::motion_text(lab::with_steps(lab::parse_motion(motion), light, 0.02f, 50));
    };
    EXPECT_EQ(text("camera", sun), "camera,right=0.04,frames=8");
    EXPECT_EQ(text("camera,turn=1", sun), "camera,turn=1,frames=8");
    EXPECT_EQ(text("light", sun), "light,azimuth=0.5,frames=8");
    EXPECT_EQ(text("light", point), "light,x=0.5,frames=8");
    EXPECT_EQ(text("time", sun), "time,step=0.0333333,frames=8");
    EXPECT_THROW(text("light,azimuth=1", point), base::Error);
    EXPECT_THROW(text("light,x=1", sun), base::Error);
}
