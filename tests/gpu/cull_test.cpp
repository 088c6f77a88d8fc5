// SPDX-License-Identifier: Apache-2.0
#include "technique_fixture.h"

#include "shaders/bias.shared.h"

#include "scene/load.h"
#include "shadow/parts/cull.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sdsm.h"
#include "src/shadow/casters.shared.h"

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;

namespace gnomon {
namespace {

using shadow::parts::Culling;
using shadow::parts::Fit;
using shadow::parts::LightMapSettings;

constexpr gpu::Size picture{192, 108};

/// Counts instances in place of drawing them.
class Counter final : public gpu::Encoder {
public:
    uint32_t instances = 0;
    void vertex_buffer(uint32_t, const gpu::Buffer&, uint64_t) override { }
    void index_buffer(const gpu::Buffer&, uint64_t) override { }
    void vertex_buffer(uint32_t, gpu::BufferId, uint64_t) override { }
    void index_buffer(gpu::BufferId, uint64_t) override { }
    void cull(VkCullModeFlags) override { }
    void depth_bias(float, float, float) override { }
    void scissor(int, int, uint32_t, uint32_t) override { }
    void viewport(float, float, float, float) override { }
    void draw(uint32_t, uint32_t, uint32_t, uint32_t) override { }
    void draw_indexed(uint32_t, uint32_t count, uint32_t, int32_t, uint32_t) override { instances += count; }
    void draw_indexed_indirect(gpu::BufferId, uint64_t, uint32_t, uint32_t) override { }
    void draw_indirect(gpu::BufferId, uint64_t, uint32_t, uint32_t) override { }
    void program(const gpu::Program&) override { }
    VkCommandBuffer handle() override { return VK_NULL_HANDLE; }
};

class Cull : public gpu::TechniqueTest {
protected:
    struct Counts {
        uint32_t all = 0, frustum = 0, chosen = 0; ///< instances drawn, over all layers: the last by the GPU
    };

    static Counts count(const scene::Scene& s, const scene::View& view, const char* sun, Fit fit, Culling by)
    {
        const scene::Light light = scene::parse_light(sun, {}, s.bounds());
        shadow::SceneGpu resources(device(), s);
        gpu::Image out = image("visibility", VK_FORMAT_R32_SFLOAT, picture);
        gpu::PassList passes(device());
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, resources, view, {.material = false});
        const shadow::Frame frame{s, view, light, resources, g, passes.import(out), 0};
        const LightMapSettings settings{.fitting = {.fit = int(fit)}, .guard_texels = 3.5f};
        shadow::parts::LightMap map;
        map.constants = shadow::parts::fit_light_map(s, s.bounds(), view, light, settings);
        if (fit == Fit::sdsm) map.fitted = shadow::parts::fit_to_samples(passes, frame, settings, map.constants);
        const gpu::BufferId commands = shadow::parts::cull_casters(passes, frame, map, by, settings.guard_texels);
        const uint32_t entries = map.constants.layer_count * resources.slot_count();
        gpu::Buffer result = storage<shaders::DrawCommand>("commands", entries);
        passes.copy(commands, passes.import(result), entries * sizeof(shaders::DrawCommand));
        device().submit(std::move(passes));

        Counts counts;
        for (const shaders::DrawCommand& c : values<shaders::DrawCommand>(result)) counts.chosen += c.instance_count;
        for (uint32_t layer = 0; layer < map.constants.layer_count; ++layer) {
            const shadow::Planes planes = shadow::parts::caster_planes(map.constants.layers[layer]);
            Counter all, inside;
            resources.draw(all, {.sets = shadow::draw_opaque | shadow::draw_masked});
            resources.draw(inside, {.sets = shadow::draw_opaque | shadow::draw_masked, .cull = &planes});
            counts.all += all.instances, counts.frustum += inside.instances;
        }
        return counts;
    }

    /// Sheets at all heights over a floor, and under it, where they shade nothing.
    static scene::Scene sheets()
    {
        scene::Scene s = gpu::floor_scene(20);
        for (int i = 0; i < 60; ++i)
            gpu::add_quad(s, {float(i % 8) * 5 - 17, float(i % 7) * 1.5f - 4.2f, float(i / 8) * 5 - 17}, 0.3f + 0.02f * float(i));
        return s;
    }

    static constexpr const char* suns[]
        = {"sun,elevation=35,azimuth=120,angle=0", "sun,elevation=8,azimuth=300,angle=0", "sun,elevation=90,angle=0"};
};

TEST_F(Cull, ChangesNoPixel)
{
    const scene::Scene s = sheets();
    const scene::Camera low{.eye = {0, 2, 19}, .target = {2, 0, 3}}, beside{.eye = {-14, 3, -4}, .target = {0, -1, -18}};
    for (const scene::Camera& camera : {low, beside})
        for (const char* sun : suns)
            for (const Fit fit : {Fit::focused, Fit::cascades, Fit::sdsm})
                for (const int bias : {BIAS_CONE, BIAS_NORMAL_OFFSET, BIAS_DUAL_LAYERS, BIAS_IDS}) {
                    const auto with = [&](double culling) {
                        return draw(technique_shadow_map, s, camera, picture, sun,
                            {{"map_size", 512}, {"fit", double(fit)}, {"bias", double(bias)}, {"pcf", 5}, {"culling", culling}});
                    };
                    const std::vector<float> all = with(0);
                    EXPECT_GT(mean(all), 0.05);
                    EXPECT_EQ(with(1), all) << sun << int(fit);
                    EXPECT_EQ(with(2), all) << sun << int(fit);
                }
}

TEST_F(Cull, LeavesOutWhatShadesNoVisibleReceiver)
{
    const scene::Scene s = sheets();
    const scene::View view = scene::make_view({.eye = {0, 2, 19}, .target = {2, 0, 3}}, picture, s.bounds());
    for (const Fit fit : {Fit::focused, Fit::cascades, Fit::sdsm}) {
        const Counts c = count(s, view, "sun,elevation=90,angle=0", fit, Culling::frustum);
        const uint32_t receivers = count(s, view, "sun,elevation=90,angle=0", fit, Culling::receivers).chosen;
        EXPECT_LE(c.frustum, c.all);
        // the same layers, but by whole texels; of those that the GPU fits the CPU has a bound
        if (fit == Fit::sdsm)
            EXPECT_LT(double(c.chosen), 0.8 * double(c.frustum));
        else
            EXPECT_NEAR(double(c.chosen), double(c.frustum), 0.05 * double(c.frustum));
        EXPECT_GT(receivers, 4u);
        // what lies under the floor is inside the layers, and shades nothing that is seen
        EXPECT_LT(double(receivers), 0.8 * double(c.chosen)) << int(fit);
    }
    const scene::View away = scene::make_view({.eye = {0, 2, 80}, .target = {0, 2, 160}}, picture, s.bounds());
    EXPECT_EQ(count(s, away, "sun,elevation=90,angle=0", Fit::cascades, Culling::receivers).chosen, 0u) << "no receiver, no caster";
    const scene::View above = scene::make_view({.eye = {0, 30, 19}, .target = {2, 0, 3}}, picture, s.bounds());
    EXPECT_EQ(count(s, above, "sun,elevation=-60,angle=0", Fit::focused, Culling::receivers).chosen, 0u) << "all that is seen faces away";
}

} // namespace
} // namespace gnomon
