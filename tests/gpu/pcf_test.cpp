// SPDX-License-Identifier: Apache-2.0
// The technique as a whole, on scenes of a few quads: what its filters are in closed form, and what its biases promise.
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>

extern const gnomon::shadow::TechniqueInfo technique_pcf;

namespace gnomon {
namespace {

using gpu::add_quad;
using gpu::camera_above;
using gpu::floor_scene;
using gpu::half_shadowed;

class Pcf : public gpu::TechniqueTest {
protected:
    static std::vector<float> draw(
        const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        return TechniqueTest::draw(technique_pcf, s, camera, size, light, values);
    }
};

constexpr double box = 0, poisson = 3, vogel = 4, receiver_plane = 3, cone = 4;

TEST_F(Pcf, TiltedPlanesDoNotShadowThemselves)
{
    const scene::Scene s = floor_scene(10);
    const scene::Camera camera{.eye = {0, 6, 9}, .target = {0, 0, 0}};
    // the floor is tilted by 90 degrees less the elevation; point and spot lights see all tilts at once
    for (const char* light : {"sun,elevation=90,angle=0", "sun,elevation=60,azimuth=20,angle=0", "sun,elevation=30,azimuth=70,angle=0",
             "sun,elevation=15,azimuth=200,angle=0", "sun,elevation=10,azimuth=33,angle=0", "point,position=1/2/0.5,radius=0",
             "spot,position=4/3/1,target=-2/0/0,cone=80,radius=0"})
        for (const double bias : {receiver_plane, cone})
            for (const double form : {box, vogel})
                for (const double kernel : {1.0, 9.0, 127.0}) {
                    if (form == box && kernel > 9) continue; // 4096 gathers a pixel
                    const Values values{
                        {"bias", bias}, {"bias_scale", bias == cone ? 0.0 : 1.0}, {"form", form}, {"kernel", kernel}, {"fit", 0}};
                    const bool spot = light[0] == 's' && light[1] == 'p';
                    size_t dark = 0;
                    const std::vector<float> got = draw(s, camera, {96, 64}, light, values);
                    for (const float v : got) dark += v < 1.0f - 1e-5f;
                    // outside of the spot's cone it is dark
                    if (spot) {
                        size_t partly = 0;
                        for (const float v : got) partly += v > 0.0f && v < 1.0f - 1e-5f;
                        EXPECT_EQ(partly, 0u) << light << ", bias " << bias << ", form " << form << ", kernel " << kernel;
                    } else {
                        EXPECT_EQ(dark, 0u) << light << ", bias " << bias << ", form " << form << ", kernel " << kernel;
                    }
                }
}

TEST_F(Pcf, CasterOneCentimetreAboveTheFloorCastsItsShadow)
{
    scene::Scene s = floor_scene(0.5f);
    add_quad(s, {0, 0.01f, 0}, 0.1f);
    for (const double bias : {receiver_plane, cone}) {
        // 45 degrees: seen from above, a strip of 1 cm beside the caster is dark; its middle is 5 mm off
        const std::vector<float> steep = draw(s, camera_above({-0.105f, 0, 0}, 3, 0.0005f), {4, 4}, "sun,elevation=45,azimuth=90,angle=0",
            {{"bias", bias}, {"kernel", 3}, {"map_size", 2048}, {"fit", 0}});
        EXPECT_LT(mean(steep), 0.01) << bias;
        // 10 degrees, a floor tilted by 80: the strip is 5.7 cm long
        const std::vector<float> flat = draw(s, camera_above({-0.128f, 0, 0}, 3, 0.0005f), {4, 4}, "sun,elevation=10,azimuth=90,angle=0",
            {{"bias", bias}, {"kernel", 3}, {"map_size", 2048}, {"fit", 0}});
        EXPECT_LT(mean(flat), 0.01) << bias;
        const std::vector<float> beyond = draw(s, camera_above({-0.18f, 0, 0}, 3, 0.0005f), {4, 4}, "sun,elevation=10,azimuth=90,angle=0",
            {{"bias", bias}, {"kernel", 3}, {"map_size", 2048}, {"fit", 0}});
        EXPECT_GT(mean(beyond), 0.99) << bias;
    }
}

TEST_F(Pcf, InterleavedGroupsAddUpToTheWholeDisk)
{
    // 32 pixels see a tenth of a texel: all of them have nearly the same window
    const scene::Scene s = half_shadowed();
    for (const double form : {poisson, vogel})
        for (const float x : {0.15f, 0.4f, 0.8f}) {
            const Values whole{{"form", form}, {"kernel", 16}, {"map_size", 64}, {"fit", 0}, {"taps", 32}, {"bias", receiver_plane}};
            Values split = whole;
            split.push_back({"interleave", 2});
            const scene::Camera camera = camera_above({x, 0, 0}, 0.5f, 0.005f);
            const std::vector<float> a = draw(s, camera, {32, 32}, "sun,elevation=90,angle=0", whole);
            const std::vector<float> b = draw(s, camera, {32, 32}, "sun,elevation=90,angle=0", split);
            EXPECT_GT(mean(a), 0.4);
            EXPECT_LT(mean(a), 0.95);
            // every pixel away from the picture's rim has all groups around it
            for (size_t y = 4; y < 28; ++y)
                for (size_t c = 4; c < 28; ++c) ASSERT_NEAR(a[y * 32 + c], b[y * 32 + c], 0.02f) << c << " " << y;
        }
}

TEST_F(Pcf, RotatedDisksAddUpToTheirMeanOverAllAngles)
{
    const scene::Scene s = half_shadowed();
    for (const double rotation : {1.0, 2.0})
        for (const float x : {0.3f, 1.0f}) {
            const Values values{{"form", vogel}, {"kernel", 16}, {"map_size", 64}, {"fit", 0}, {"taps", 16}, {"rotation", rotation},
                {"bias", receiver_plane}};
            const scene::Camera camera = camera_above({x, 0, 0}, 0.5f, 0.005f);
            const double got = mean(draw(s, camera, {64, 64}, "sun,elevation=90,angle=0", values));
            // The map of 64 texels holds the floor's 8 m and, for a reach of 9 texels, that many more at each rim. A circle of radius r
            // about the receiver lies beyond the edge for acos(x / r) / pi of its length.
            const double texel = 8.0 / (64 - 2 * 9);
            double want = 0;
            for (int i = 0; i < 16; ++i) {
                const double r = 8 * std::sqrt((i + 0.5) / 16);
                want += 1 - std::acos(std::min(1.0, double(x) / texel / r)) / 3.14159265;
            }
            EXPECT_NEAR(got, want / 16, 0.015) << "rotation " << rotation << ", x " << x;
        }
}

TEST_F(Pcf, FootprintAveragesOverThePixel)
{
    scene::Scene s = floor_scene(200);
    add_quad(s, {-100, 1, 0}, 100);
    // 2.5 m a pixel are several texels of 0.4 m. The pixel across the shadow's edge sees its lit share; one tap sees all or nothing.
    constexpr float pixel = 2.5f;
    const auto largest_error = [&](double window) {
        double worst = 0;
        for (float edge = 0.05f; edge < 1; edge += 0.1f) {
            const float x = pixel * (0.5f - edge); // of the middle of pixel (8, 8)
            const scene::Camera camera = camera_above({x - 0.5f * pixel, 0, -0.5f * pixel}, 0.9f, 8 * pixel);
            const std::vector<float> v = draw(s, camera, {16, 16}, "sun,elevation=90,angle=0",
                {{"kernel", 1}, {"map_size", 1024}, {"fit", 0}, {"window", window}, {"bias", receiver_plane}});
            worst = std::max(worst, std::abs(double(v[8 * 16 + 8]) - double(1 - edge)));
        }
        return worst;
    };
    EXPECT_GT(largest_error(0), 0.3);
    EXPECT_LT(largest_error(1), 0.1);
}

TEST_F(Pcf, KernelsLargerThanTheMapAreHeldToIt)
{
    scene::Scene s = half_shadowed();
    add_quad(s, {1, 0.3f, 1}, 0.5f);
    const scene::Camera camera{.eye = {3, 2, 6}, .target = {0, 0, 0}};
    for (const char* light :
        {"sun,elevation=40,angle=0", "point,position=1/2/1,radius=0", "spot,position=3/3/1,target=0/0/0,cone=60,radius=0"})
        for (const double form : {box, 1.0, 2.0, poisson, vogel}) {
            const std::vector<float> widest = draw(s, camera, {48, 32}, light, {{"form", form}, {"kernel", 127}, {"map_size", 16}});
            for (const float v : widest) ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 1.0f) << light << " form " << form;
            EXPECT_EQ(widest, draw(s, camera, {48, 32}, light, {{"form", form}, {"kernel", 4}, {"map_size", 16}})) << "a quarter of 16";
            EXPECT_GT(mean(widest), 0.05) << light << " form " << form;
        }
}

} // namespace
} // namespace gnomon
