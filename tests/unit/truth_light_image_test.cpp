// SPDX-License-Identifier: Apache-2.0
// Lights with an image against closed forms, channel by channel.
#include "truth/cache.h"
#include "truth/truth.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gnomon;
using namespace truth_test;

namespace {

// Four metres up, a metre wide, half_u along +x: cross(half_u, half_v) = -y.
scene::Light rect_light(scene::LightImage image)
{
    scene::Light light = light_of(scene::RectLight{vec3(0, 4, 0), vec3(0.5f, 0, 0), vec3(0, 0, 0.5f)});
    light.image = std::move(image);
    return light;
}

// An edge halfway up hides what lies left of x = 0 on the light, as seen from x = 0 on the floor.
scene::Scene half_plane() { return scene_of({level_quad(-20, 20, -20, 20, 0), level_quad(-30, 0, -30, 30, 2)}); }

} // namespace

TEST(TruthLightImage, half_plane_before_two_colours)
{
    const scene::Scene s = half_plane();
    const truth::Tracer tracer(s);
    std::vector<vec3> points, normals;
    for (int i = 0; i <= 40; ++i) points.emplace_back(-0.6f + 0.03f * float(i), 0.0f, 0.1f), normals.emplace_back(0, 1, 0);
    const auto seen = tracer.colored_visibility_at(points, normals, rect_light(scene::load_light_image("halves")), {.samples = 1024});
    for (size_t i = 0; i < points.size(); ++i) {
        const double edge = -double(points[i].x); // on the light: x + 2 (0 - x)
        const auto ramp = [&](double lo, double hi) { return std::clamp((hi - edge) / (hi - lo), 0.0, 1.0); };
        EXPECT_NEAR(seen[i].x, ramp(-0.5, 0.0), 0.02) << edge;
        EXPECT_NEAR(seen[i].y, ramp(-0.5, 0.5), 0.02) << "no green light: the fraction of the area";
        EXPECT_NEAR(seen[i].z, ramp(0.0, 0.5), 0.02) << edge;
    }
}

TEST(TruthLightImage, strata_hold_the_same_of_every_texel)
{
    // 3 x 7 texels do not divide 8 x 8 strata; one texel alone emits red
    std::vector<vec3> texels(21, vec3(0, 1, 0.5f));
    texels[10] = vec3(1, 0, 0.5f);
    const scene::Scene s = scene_of({level_quad(-20, 20, -20, 20, 0)});
    const truth::Tracer tracer(s);
    const scene::Light light = rect_light(scene::make_light_image(3, 7, texels, "spot"));
    for (const auto& seen : tracer.colored_visibility_at({vec3(0), vec3(1, 0, 2)}, {vec3(0, 1, 0), vec3(0, 1, 0)}, light, {.samples = 64}))
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 1.0, 1e-6);
}

TEST(TruthLightImage, pictures_have_three_channels_and_honest_variance)
{
    const scene::Scene s = half_plane(), floor = scene_of({level_quad(-20, 20, -20, 20, 0)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, vec3(2, 1, 3), vec3(0, 0, 0), {48, 32});
    const truth::Primary primary = tracer.primary(view);
    const scene::Light light = rect_light(scene::load_light_image("window"));
    const truth::Visibility coarse = tracer.visibility(view, primary, light, {.samples = 256});
    const truth::Visibility fine = tracer.visibility(view, primary, light, {.samples = 4096, .seed = 2});
    ASSERT_EQ(coarse.mean.channels, 3);
    EXPECT_EQ(coarse.samples, 21 * 16);
    double squares = 0, variance = 0;
    for (size_t i = 0; i < coarse.mean.values.size(); ++i) {
        ASSERT_GE(coarse.mean.values[i], 0.0f);
        ASSERT_LE(coarse.mean.values[i], 1.0f);
        squares += std::pow(double(coarse.mean.values[i] - fine.mean.values[i]), 2), variance += double(coarse.variance.values[i]);
    }
    const truth::Tracer open(floor);
    for (const float v : open.visibility(view, open.primary(view), light, {.samples = 64}).variance.values)
        ASSERT_EQ(v, 0.0f) << "where all is seen nothing is uncertain";
    EXPECT_GT(squares, 0.0);
    EXPECT_GT(variance, 0.7 * squares) << "never too small";
    EXPECT_LT(variance, 8.0 * squares);
}

TEST(TruthLightImage, a_uniform_image_is_no_image)
{
    const scene::Scene s = half_plane();
    const truth::Tracer tracer(s);
    const scene::View view = look(s, vec3(2, 1, 3), vec3(0, 0, 0), {48, 32});
    const truth::Primary primary = tracer.primary(view);
    const truth::Visibility grey = tracer.visibility(view, primary, rect_light({}), {.samples = 64});
    const scene::Light light = rect_light(scene::make_light_image(2, 4, std::vector<vec3>(8, vec3(0.3f, 0.2f, 0)), "uniform"));
    const truth::Visibility colored = tracer.visibility(view, primary, light, {.samples = 64});
    ASSERT_EQ(grey.mean.channels, 1);
    for (size_t i = 0; i < grey.mean.values.size(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(colored.mean.values[3 * i + c], grey.mean.values[i]);
            ASSERT_EQ(colored.variance.values[3 * i + c], grey.variance.values[i]);
        }
}

TEST(TruthLightImage, the_cache_tells_images_apart)
{
    const scene::Scene s = half_plane();
    const scene::View view = look(s, vec3(2, 1, 3), vec3(0, 0, 0), {16, 8});
    const auto key = [&](const scene::Light& l) { return truth::cache_key(s, view, l, {.samples = 16}, truth::Quantity::visibility); };
    const scene::Light plain = rect_light({}), halves = rect_light(scene::load_light_image("halves"));
    EXPECT_NE(key(plain), key(halves));
    EXPECT_NE(key(rect_light(scene::load_light_image("window"))), key(halves));
    const auto folder = std::filesystem::path(testing::TempDir()) / "gnomon_light_image_truth";
    std::filesystem::remove_all(folder);
    const truth::Reference first = truth::reference(s, view, halves, {.samples = 16}, truth::Quantity::visibility, folder);
    const truth::Reference second = truth::reference(s, view, halves, {.samples = 16}, truth::Quantity::visibility, folder);
    EXPECT_FALSE(first.from_cache);
    EXPECT_TRUE(second.from_cache);
    EXPECT_EQ(first.visibility.mean.values, second.visibility.mean.values);
    std::filesystem::remove_all(folder);
}
