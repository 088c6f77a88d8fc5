// SPDX-License-Identifier: Apache-2.0
// Images that techniques leave for people to look at (shadow::Inspection).
#include "scene/load.h"
#include "soft_fixture.h"

#include <algorithm>
#include <cmath>
#include <set>

extern const gnomon::shadow::TechniqueInfo technique_pcss, technique_vssm, technique_cssm, technique_moment_soft,
    technique_virtual_shadow_map, technique_shadow_map;

namespace gnomon {
namespace {

class Inspections : public gpu::TechniqueTest {
protected:
    struct Drawn {
        std::vector<float> output;
        std::vector<shadow::Inspection> inspections; ///< their ids mean nothing any more
        std::vector<std::vector<float>> values; ///< of each
    };
    static Drawn draw_inspected(
        const shadow::TechniqueInfo& info, const scene::Scene& s, const scene::Camera& camera, gpu::Size size, const char* light_text)
    {
        const scene::Light light = scene::parse_light(light_text, {}, s.bounds());
        const scene::View view = scene::make_view(camera, size, s.bounds());
        const shadow::ParamValues params(info.params());
        shadow::SceneGpu scene(device(), s);
        Drawn drawn;
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, size);
        const std::unique_ptr<shadow::Technique> technique = info.create(device());
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
        shadow::Frame frame{s, view, light, scene, g, passes.import(out)};
        frame.inspections = &drawn.inspections;
        technique->record(passes, frame, params.bytes());
        std::vector<gpu::Image> kept(drawn.inspections.size());
        for (size_t i = 0; i < kept.size(); ++i) {
            kept[i] = image("kept", VK_FORMAT_R32_SFLOAT, size);
            passes.copy(drawn.inspections[i].image, passes.import(kept[i]));
        }
        device().submit(std::move(passes));
        drawn.output = device().read_back(out).values;
        for (gpu::Image& i : kept) drawn.values.push_back(device().read_back(i).values);
        return drawn;
    }
};

TEST_F(Inspections, LeaveTheShadowAsItIs)
{
    const scene::Scene s = scene::load("balls");
    const scene::Camera camera = scene::fit_camera(s.bounds());
    const char* sun = "sun,elevation=40,azimuth=30,angle=3";
    for (const shadow::TechniqueInfo* info :
        {&technique_pcss, &technique_vssm, &technique_cssm, &technique_moment_soft, &technique_virtual_shadow_map}) {
        const Drawn inspected = draw_inspected(*info, s, camera, {96, 54}, sun);
        EXPECT_FALSE(inspected.inspections.empty()) << info->id;
        EXPECT_EQ(inspected.output, draw(*info, s, camera, {96, 54}, sun, {})) << info->id;
    }
    EXPECT_TRUE(draw_inspected(technique_shadow_map, s, camera, {96, 54}, sun).inspections.empty());
}

TEST_F(Inspections, PenumbraeAreAsWideAsTheLightCastsThem)
{
    // an edge one metre above the floor
    const scene::Scene s = gpu::half_plane();
    for (const shadow::TechniqueInfo* info : {&technique_pcss, &technique_vssm, &technique_cssm, &technique_moment_soft})
        for (const auto& [light, width] : {std::pair{"sun,elevation=90,azimuth=0,angle=20", 2 * std::tan(glm::radians(10.0))},
                 {"rect,position=0/4/0,target=0/0/0,width=0.6,height=0.6", 0.6 / 3}}) {
            const Drawn d = draw_inspected(*info, s, gpu::camera_above({0, 0, 0}, 0.9f, 0.2f), {32, 32}, light);
            ASSERT_EQ(d.inspections.size(), 1u);
            EXPECT_EQ(d.inspections[0].name, "penumbra");
            EXPECT_EQ(d.inspections[0].unit, "m");
            // in its middle, where half of the light is hidden
            double least = 1e9, most = 0;
            for (size_t y = 0; y < 32; ++y) {
                least = std::min(least, double(d.values[0][y * 32 + 16]));
                most = std::max(most, double(d.values[0][y * 32 + 16]));
            }
            EXPECT_NEAR(least, width, 0.12 * width) << info->id << " " << light;
            EXPECT_NEAR(most, width, 0.12 * width) << info->id << " " << light;
        }
}

TEST_F(Inspections, WhereNothingIsEstimatedNothingIsSaid)
{
    const scene::Scene s = gpu::half_plane();
    const Drawn d
        = draw_inspected(technique_pcss, s, gpu::camera_above({3, 0, 0}, 0.9f, 0.2f), {16, 16}, "sun,elevation=90,azimuth=0,angle=20");
    EXPECT_EQ(d.values.at(0), std::vector<float>(256, -1.0f)) << "lit for certain";
}

TEST_F(Inspections, PagesAndLevelsAreWholeNumbersOfReceivers)
{
    const scene::Scene s = scene::load("balls");
    const Drawn d
        = draw_inspected(technique_virtual_shadow_map, s, scene::fit_camera(s.bounds()), {192, 108}, "sun,elevation=40,azimuth=30,angle=0");
    ASSERT_EQ(d.inspections.size(), 2u);
    EXPECT_EQ(d.inspections[0].name, "page");
    EXPECT_EQ(d.inspections[1].name, "level");
    const std::set<float> pages(d.values[0].begin(), d.values[0].end()), levels(d.values[1].begin(), d.values[1].end());
    EXPECT_GT(pages.size(), 8u);
    EXPECT_GT(levels.size(), 2u);
    for (const std::set<float>* set : {&pages, &levels})
        for (const float v : *set) EXPECT_TRUE(v == -1.0f || (v >= 0.0f && v == std::floor(v))) << v;
    EXPECT_LT(*pages.rbegin(), 1024.0f);
    // a page belongs to one level
    std::map<float, float> level_of;
    for (size_t i = 0; i < d.values[0].size(); ++i) {
        const auto [found, fresh] = level_of.emplace(d.values[0][i], d.values[1][i]);
        EXPECT_EQ(found->second, d.values[1][i]) << "page " << d.values[0][i];
    }
}

} // namespace
} // namespace gnomon
