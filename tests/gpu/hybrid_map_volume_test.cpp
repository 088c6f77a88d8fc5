// SPDX-License-Identifier: Apache-2.0
// Against rays at every pixel: where the map is sampled finely enough for all that casts, no pixel may differ; of what it misses, how much.
#include "technique_fixture.h"

#include "scene/load.h"

extern const gnomon::shadow::TechniqueInfo technique_hybrid_map_volume;
extern const gnomon::shadow::TechniqueInfo technique_ray_traced;
extern const gnomon::shadow::TechniqueInfo technique_shadow_volumes;

namespace gnomon {
namespace {

class HybridMapVolume : public gpu::TechniqueTest {
protected:
    struct Difference {
        size_t wrong = 0; ///< pixels
        double dark = 0; ///< part of the picture
        uint64_t marked = 0;
    };

    void SetUp() override
    {
        TechniqueTest::SetUp();
        if (!device().info().ray_query) GTEST_SKIP() << "no ray queries on this device";
    }

    static Difference from_rays(const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light, const Values& values)
    {
        const std::vector<float> rays = draw(technique_ray_traced, s, camera, size, light, {});
        const std::vector<float> got = draw(technique_hybrid_map_volume, s, camera, size, light, values);
        Difference d;
        for (size_t i = 0; i < got.size(); ++i) d.wrong += got[i] != rays[i];
        d.dark = 1 - mean(rays);
        d.marked = count(technique_hybrid_map_volume, s, camera, size, light, values).at("boundary_pixels");
        return d;
    }

    /// Sheets a third of a metre wide and wider at all heights, turned and tilted, some of which touch the floor or one another.
    static scene::Scene sheets()
    {
        scene::Scene s = gpu::floor_scene(6);
        for (int i = 0; i < 24; ++i) {
            gpu::add_quad(s, vec3(0), 0.2f + 0.03f * float(i));
            const mat4 place = glm::translate(mat4(1), {float(i % 5) * 2 - 4, 0.25f * float(i % 7), float(i / 5) * 2 - 4});
            const mat4 tilt = glm::rotate(glm::rotate(mat4(1), 0.7f * float(i), vec3(0, 1, 0)), 0.2f * float(i % 4), vec3(1, 0, 0));
            s.instances.back().world_from_object = place * tilt;
        }
        return s;
    }

    /// Bars of this width, four to a metre, over a floor.
    static scene::Scene bars(float width)
    {
        scene::Scene s = gpu::floor_scene(4);
        scene::Mesh m;
        for (int i = 0; i < 32; ++i) {
            const float x = -4 + 0.25f * float(i) + 0.0937f, end = 4;
            const auto first = uint32_t(m.positions.size());
            m.positions.insert(m.positions.end(), {{x, 1, -end}, {x, 1, end}, {x + width, 1, end}, {x + width, 1, -end}});
            for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) m.indices.push_back(first + k);
        }
        scene::complete(m);
        s.instances.push_back({int(s.meshes.size()), mat4(1)});
        s.meshes.push_back(m);
        return s;
    }

    static constexpr gpu::Size picture{192, 128};
    inline static const scene::Camera oblique{.eye = {4, 5, 7}, .target = {0, 0, 0}};
};

TEST_F(HybridMapVolume, WhatTexelsShowIsExactWithEveryFitAndLight)
{
    const scene::Scene s = sheets();
    for (const char* light : {"sun,elevation=50,azimuth=20,angle=0", "sun,elevation=24,azimuth=200,angle=0",
             "spot,position=5/6/2,target=0/0/0,cone=70,radius=0", "point,position=1/5/1,radius=0"})
        for (int fit = 0; fit < 8; ++fit) {
            const bool layers = light[1] != 'u'; // fits are of suns and spots, layouts of points
            if (layers && fit > 2) continue;
            const Values values{{"map_size", 1024}, {layers ? "point_layout" : "fit", double(fit)}};
            const Difference d = from_rays(s, oblique, picture, light, values);
            EXPECT_EQ(d.wrong, 0u) << light << ", " << fit;
            EXPECT_GT(d.dark, 0.04);
            EXPECT_GT(d.marked, 200u) << light << ", " << fit;
            EXPECT_LT(double(d.marked), 0.5 * double(picture.area())) << light << ", " << fit;
        }
}

TEST_F(HybridMapVolume, SmallerMapsMarkMore)
{
    const scene::Scene s = sheets();
    uint64_t before = ~0ull;
    for (const double size : {128., 512., 2048.}) {
        const Difference d = from_rays(s, oblique, picture, "sun,elevation=50,azimuth=20,angle=0", {{"map_size", size}});
        EXPECT_EQ(d.wrong, 0u) << size;
        EXPECT_LT(d.marked, before);
        before = d.marked;
    }
}

/// Under an overhead sun, with a map of one texel for 8.1 m / size.
TEST_F(HybridMapVolume, BarsAreMissedWhereNarrowerThanATexelOnly)
{
    const scene::Camera above = gpu::camera_above({0, 0, 0}, 0.9f, 3); // below the bars: the floor alone is seen
    const gpu::Size fine{512, 512};
    const auto missed = [&](float width, double size, double reach) {
        const Difference d
            = from_rays(bars(width), above, fine, "sun,elevation=90,angle=0", {{"map_size", size}, {"fit", 0}, {"reach", reach}});
        EXPECT_NEAR(d.dark, double(width) * 4, 0.02);
        return double(d.wrong) / double(fine.area()) / d.dark;
    };
    EXPECT_EQ(missed(0.06f, 256, 1), 0);
    EXPECT_EQ(missed(0.03f, 512, 1), 0);
    const double coarse = missed(0.015f, 128, 1), finer = missed(0.015f, 256, 1), finest = missed(0.015f, 1024, 1);
    RecordProperty("missed_of_the_dark", std::to_string(coarse) + " " + std::to_string(finer) + " " + std::to_string(finest));
    EXPECT_GT(coarse, 0.05);
    EXPECT_LT(finer, coarse);
    EXPECT_EQ(finest, 0);
    EXPECT_LT(missed(0.015f, 128, 4), coarse) << "a wider look around finds more of them";
}

TEST_F(HybridMapVolume, WhatTheMapCannotTellIsAskedOfRays)
{
    const scene::Scene s = sheets();
    for (const char* light : {"sun,elevation=2,azimuth=40,angle=0", // grazing
             "point,position=0/0.01/0,radius=0", // the same, from within
             "point,position=4/5/7,radius=0", "sun,direction=-4/-5/-7,angle=0"}) { // along the view
        const Difference d = from_rays(s, oblique, picture, light, {{"map_size", 2048}});
        EXPECT_LE(d.wrong, 2u) << light;
    }
    // one texel stands for nothing
    const Difference small = from_rays(s, oblique, picture, "sun,elevation=50,azimuth=20,angle=0", {{"map_size", 16}, {"reach", 8}});
    EXPECT_EQ(small.wrong, 0u);
    EXPECT_GT(small.marked, uint64_t(picture.area()) / 2);
}

TEST_F(HybridMapVolume, VolumesDecideAsRaysDo)
{
    const scene::Scene s = sheets();
    const scene::Camera level{.eye = {0, 6, 1}, .target = {0, 0, 0}, .half_height = 4}, within{.eye = {0, 0.4f, 3}, .target = {1, 0, 0}};
    for (const scene::Camera& camera : {oblique, level, within})
        for (const char* light : {"sun,elevation=50,azimuth=20,angle=0", "spot,position=5/6/2,target=0/0/0,cone=70,radius=0",
                 "point,position=1/2.2/1,radius=0", "sun,elevation=2,azimuth=40,angle=0"})
            for (const double size : {64., 512.}) {
                const Difference d = from_rays(s, camera, picture, light, {{"map_size", size}, {"exact", 1}});
                const Difference rays = from_rays(s, camera, picture, light, {{"map_size", size}});
                EXPECT_EQ(d.marked, rays.marked);
                EXPECT_LE(d.wrong, rays.wrong + 2) << light << ", " << size;
            }
}

/// Fragments of volumes run their shader at marked pixels alone.
TEST_F(HybridMapVolume, VolumesAreDrawnWhereTexelsDisagree)
{
    const scene::Scene s = sheets();
    const char* sun = "sun,elevation=50,azimuth=20,angle=0";
    const auto hybrid = count(technique_hybrid_map_volume, s, oblique, picture, sun, {{"exact", 1}});
    const auto volumes = count(technique_shadow_volumes, s, oblique, picture, sun, {});
    const double marked = double(hybrid.at("boundary_pixels")) / double(picture.area());
    EXPECT_GT(marked, 0.005);
    EXPECT_LT(marked, 0.1);
    EXPECT_LT(double(hybrid.at("fragments")), 4 * marked * double(volumes.at("fragments")));
    EXPECT_LE(hybrid.at("stencil_updates"), hybrid.at("fragments"));
}

} // namespace
} // namespace gnomon
