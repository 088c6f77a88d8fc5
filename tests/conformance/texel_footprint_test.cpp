// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/render.h"
#include "shadow/parts/texel_footprint.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace gnomon {
namespace {

namespace parts = shadow::parts;

gpu::Device& device()
{
    const char* name = std::getenv("GNOMON_DEVICE");
    static const std::unique_ptr<gpu::Device> shared = gpu::Device::open({name ? name : "", true});
    return *shared;
}

const std::array<std::string, 3> names = {"texel_footprint", "texel_footprint_perspective", "texel_footprint_projection"};

struct Score {
    size_t shown = 0, wrong = 0, where = 0; ///< where: a value on one side only
};

/// The images of shadow_map without filter, against the Jacobian in double precision.
Score compare(const std::string& scene_name, const std::string& camera, const std::string& light, int fit)
{
    const lab::Stage stage = lab::open_stage({scene_name, {}, camera, {light}, {160, 90}});
    shadow::SceneGpu scene(device(), stage.scene);
    lab::Choice choice = lab::parse_choice("shadow_map:map_size=512:pcf=1:bilinear=0");
    choice.params.set("fit", choice.params.table().find("fit")->choices[size_t(fit)]);
    const lab::Rendered rendered = lab::render(
        device(), scene, stage, choice, {.lit = false, .aovs = {names[0], names[1], names[2], "position", "geometric_normal", "depth"}});
    // what the technique asks for: a nearest tap reaches half a texel
    const shaders::LightMap map = parts::fit_light_map(
        stage.scene, scene.bounds(), stage.view, stage.lights.front(), {.size = 512, .fitting = {.fit = fit}, .guard_texels = 1.5f});
    const auto vector = [&](const char* name, int x, int y) {
        const base::Picture& p = rendered.aovs.at(name);
        return vec3(p.at(x, y, 0), p.at(x, y, 1), p.at(x, y, 2));
    };
    Score out;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 160; ++x) {
            const bool shown = rendered.aovs.at(names[0]).at(x, y) > 0.0f;
            out.shown += shown;
            if (rendered.aovs.at("depth").at(x, y) == 0.0f) {
                out.where += shown;
                continue;
            }
            const vec3 p = vector("position", x, y), n = vector("geometric_normal", x, y);
            const shaders::LightMapLayer& layer = map.layers[tests::select_layer(map, p)];
            const vec4 source = scene::light_point(stage.lights.front(), p, vec2(0.5f));
            const float facing = glm::dot(n, glm::normalize(vec3(source) - source.w * p));
            if (std::abs(facing) < 0.02f) continue; // a surface edge-on to the light: any number is right
            out.where += shown != (facing > 0.0f && tests::project(layer, p).inside);
            if (!shown) continue;
            const parts::TexelFootprint f = parts::texel_footprint(layer, 512, stage.view, p, n);
            const double expected[] = {parts::longer_edge(f.total), parts::longer_edge(f.perspective), f.projection};
            bool right = true;
            for (size_t i = 0; i < 3; ++i)
                right = right && std::abs(double(rendered.aovs.at(names[i]).at(x, y)) / expected[i] - 1.0) < 0.01;
            out.wrong += !right;
        }
    return out;
}

TEST(TexelFootprint, ImagesAreTheJacobian)
{
    const size_t fits = shadow::technique("shadow_map").params().find("fit")->choices.size();
    for (const char* scene : {"tilted_planes", "terrain", "balls"})
        for (const char* camera : {"", "fit,ortho=4"}) {
            for (size_t fit = 0; fit < fits; ++fit) {
                SCOPED_TRACE(std::string(scene) + " " + camera + ", fit " + std::to_string(fit));
                const Score s = compare(scene, camera, "sun,elevation=40,azimuth=120,angle=0", int(fit));
                EXPECT_GT(s.shown, 1000u);
                EXPECT_LE(s.wrong, s.shown / 200);
                EXPECT_LE(s.where, 20u);
            }
            const Score s = compare(scene, camera, "point,position=2/30/3,radius=0", int(parts::Fit::focused));
            EXPECT_GT(s.shown, 1000u) << scene;
            EXPECT_LE(s.wrong, s.shown / 200) << scene;
            EXPECT_LE(s.where, 20u) << scene;
        }
    EXPECT_TRUE(device().validation_errors().empty());
}

TEST(TexelFootprint, MapTechniquesHaveItOthersSaySo)
{
    const lab::Stage stage = lab::open_stage({"balls", {}, "", {"sun,elevation=40,azimuth=120,angle=0"}, {32, 18}});
    shadow::SceneGpu scene(device(), stage.scene);
    for (const char* technique : {"shadow_map", "pcf", "vsm", "pcss:map_size=128"}) {
        const lab::Rendered rendered
            = lab::render(device(), scene, stage, lab::parse_choice(technique), {.lit = false, .aovs = {"texel_footprint"}});
        float largest = 0;
        for (const float v : rendered.aovs.at("texel_footprint").values) largest = std::max(largest, v);
        EXPECT_GT(largest, 0.0f) << technique;
    }
    if (!shadow::technique("ray_traced").unavailable(device()).empty()) return;
    const lab::Choice rays = lab::parse_choice("ray_traced");
    EXPECT_THROW(lab::render(device(), scene, stage, rays, {.lit = false, .aovs = {"texel_footprint"}}), base::Error);
}

} // namespace
} // namespace gnomon
