// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/load.h"
#include "truth/truth.h"

#include <chrono>
#include <gtest/gtest.h>
#include <thread>

namespace gnomon {

namespace {

TEST(TruthStop, ends_between_two_pixels)
{
    const scene::Scene scene = scene::load("balls");
    const scene::View view = scene::make_view(scene.cameras.front(), {640, 360}, scene.bounds());
    const scene::Light panel = scene::parse_light("panel", scene.lights, scene.bounds());
    const truth::Tracer tracer(scene);
    const truth::Primary primary = tracer.primary(view);
    std::stop_source stop;
    const std::jthread later([&stop] {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        stop.request_stop();
    });
    const auto begin = std::chrono::steady_clock::now();
    // hours, were it not stopped
    EXPECT_THROW(tracer.visibility(view, primary, panel, {.samples = 1 << 20, .stop = stop.get_token()}), base::Error);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(TruthStop, stops_hard_lights_too)
{
    const scene::Scene scene = scene::load("plane");
    const scene::View view = scene::make_view(scene.cameras.front(), {64, 36}, scene.bounds());
    std::stop_source stop;
    stop.request_stop();
    const truth::Tracer tracer(scene);
    const scene::Light sun = scene::parse_light("sun,angle=0", scene.lights, scene.bounds());
    EXPECT_THROW(tracer.visibility(view, tracer.primary(view), sun, {.stop = stop.get_token()}), base::Error);
}

} // namespace

} // namespace gnomon
