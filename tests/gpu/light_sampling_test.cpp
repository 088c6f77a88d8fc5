// SPDX-License-Identifier: Apache-2.0
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_light_sampling;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;
using gpu::half_shadowed;

constexpr double maps = 0, rays = 1, jittered = 0, hammersley = 1;

class LightSampling : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return TechniqueTest::draw(technique_light_sampling, s, camera, size, light, values);
    }
    static scene::Scene cluttered()
    {
        scene::Scene s = half_shadowed();
        add_quad(s, {1, 0.3f, 1}, 0.5f);
        add_quad(s, {0.5f, 0.8f, -1}, 0.3f);
        return s;
    }
    /// One that takes one layer from afar, and several faces of a cube from within.
    static constexpr const char* lights[] = {"sun,elevation=50,azimuth=20,angle=10", "spot,position=3/4/1,target=0/0/0,cone=70,radius=0.3",
        "point,position=1/2/1,radius=0.4", "point,position=0.5/0.5/0.2,radius=0.3", "rect,position=2/4/1,target=0/0/0,width=1,height=0.6",
        "disk,position=-1/0.9/1,target=0/0/0,radius=0.4"};
    static constexpr scene::Camera oblique{.eye = {3, 3, 6}, .target = {0, 0, 0}};
};

TEST_F(LightSampling, BatchesDoNotChangeABit)
{
    const scene::Scene s = cluttered();
    for (const char* light : lights) {
        const Values all{{"samples", 13}, {"map_size", 64}};
        const std::vector<float> eight = draw(s, oblique, {48, 32}, light, all);
        EXPECT_GT(mean(eight), 0.05) << light;
        for (const double batch : {1.0, 3.0, 5.0}) {
            Values some = all;
            some.push_back({"batch", batch});
            EXPECT_EQ(eight, draw(s, oblique, {48, 32}, light, some)) << light << ", batch " << batch;
        }
    }
}

TEST_F(LightSampling, OneSampleIsTheHardShadowOfTheCentre)
{
    const scene::Scene s = cluttered();
    const auto same = [&](const char* soft, const char* hard) {
        for (const double by : {maps, rays}) {
            if (by == rays && !device().info().ray_query) continue;
            const std::vector<float> want = draw(s, oblique, {48, 32}, hard, {{"by", by}, {"map_size", 256}});
            EXPECT_EQ(draw(s, oblique, {48, 32}, soft, {{"by", by}, {"map_size", 256}, {"samples", 1}}), want) << soft;
            EXPECT_NE(draw(s, oblique, {48, 32}, soft, {{"by", by}, {"map_size", 256}, {"samples", 16}}), want) << soft;
        }
    };
    same("sun,elevation=50,azimuth=20,angle=10", "sun,elevation=50,azimuth=20,angle=0");
    same("point,position=1/2/1,radius=0.4", "point,position=1/2/1,radius=0");
    same("spot,position=3/4/1,target=0/0/0,cone=70,radius=0.3", "spot,position=3/4/1,target=0/0/0,cone=70,radius=0");
    // a rectangle's receivers are not those of a point: other layers
    const std::vector<float> rect = draw(s, oblique, {48, 32}, "rect,position=2/4/1,target=0/0/0,width=1,height=0.6", {{"samples", 1}});
    const std::vector<float> centre = draw(s, oblique, {48, 32}, "point,position=2/4/1,radius=0", {});
    double sum = 0;
    for (size_t i = 0; i < rect.size(); ++i) sum += std::abs(double(rect[i]) - double(centre[i]));
    EXPECT_LT(sum / double(rect.size()), 0.003);
}

TEST_F(LightSampling, MapsSeeWhatRaysToTheSamePointsSee)
{
    if (!device().info().ray_query) GTEST_SKIP() << "the device has no ray queries";
    const scene::Scene s = cluttered();
    for (const char* light : lights)
        for (const double pattern : {jittered, hammersley}) {
            const Values values{{"samples", 16}, {"pattern", pattern}, {"map_size", 1024}, {"bilinear", 0}, {"bias", 0.25}};
            Values traced = values;
            traced.push_back({"by", rays});
            const std::vector<float> a = draw(s, oblique, {96, 64}, light, values), b = draw(s, oblique, {96, 64}, light, traced);
            double sum = 0;
            for (size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - double(b[i]));
            EXPECT_LT(sum / double(a.size()), 0.003) << light << ", pattern " << pattern;
            EXPECT_GT(mean(b), 0.05) << light;
        }
}

TEST_F(LightSampling, AStraightEdgeBeforeASquareIsARamp)
{
    // A sheet whose edge is x = 0, one metre up, and a square light of one metre, four metres up: the penumbra is a third of a metre wide.
    const scene::Scene s = half_shadowed();
    for (const double pattern : {jittered, hammersley}) {
        double worst = 0;
        for (const float x : {-0.12f, -0.06f, 0.0f, 0.05f, 0.14f}) {
            const std::vector<float> v = draw(s, camera_above({x, 0, 0}, 0.5f, 0.001f), {1, 1},
                "rect,position=0/4/0,target=0/0/0,width=1,height=1", {{"samples", 256}, {"map_size", 512}, {"pattern", pattern}});
            worst = std::max(worst, std::abs(double(v[0]) - (0.5 + 3.0 * double(x))));
        }
        EXPECT_LT(worst, 0.02) << pattern;
    }
}

TEST_F(LightSampling, OddLightsGiveFractions)
{
    const scene::Scene s = cluttered();
    for (const char* light : {"point,position=1/2/1,radius=100", "point,position=0/0/0,radius=0.5", "point,position=0/0/0,radius=0",
             "rect,position=0/0/0,target=1/0/0,width=1,height=1", "disk,position=0/-3/0,target=0/0/0,radius=0.5",
             "sun,elevation=90,angle=170", "spot,position=0/0.5/0,target=0/0/0,cone=179,radius=0.2",
             "rect,position=0/3/0,target=0/0/0,width=0.00001,height=1", "disk,position=1/2000/1,target=0/0/0,radius=1"})
        for (const double fit : {0.0, 1.0})
            for (const float v : draw(s, oblique, {48, 32}, light, {{"samples", 9}, {"map_size", 16}, {"fit", fit}}))
                ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 1.0f) << light;
    const scene::Camera away{.eye = {0, 5, 0}, .target = {0, 9, 1}}; // sees nothing
    for (const float v : draw(s, away, {8, 8}, lights[0], {{"samples", 4}})) ASSERT_EQ(v, 1.0f);
}

} // namespace
} // namespace gnomon
