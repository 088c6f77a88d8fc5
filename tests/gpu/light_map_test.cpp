// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"
#include "tests/light_map_twin.h"
#include "twins.shared.h"

#include "shadow/parts/light_map.h"

#include <algorithm>
#include <random>

namespace gnomon {
namespace {

class LightMapShader : public gpu::DeviceTest { };

TEST_F(LightMapShader, ProjectsAsItsTwin)
{
    const Bounds bounds{{-4, 0, -3}, {5, 4, 6}};
    const scene::View view = scene::make_view({"", {4, 3, 9}, {0, 1, 0}, {0, 1, 0}, 0.4f}, {320, 200}, bounds);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<shaders::MapCase> cases;
    const auto add = [&](const shaders::LightMap& map) {
        for (int i = 0; i < 300; ++i)
            cases.push_back({map, bounds.min + (bounds.max - bounds.min) * vec3(unit(random), unit(random), unit(random))});
    };
    for (const char* text :
        {"sun,elevation=35,azimuth=200", "spot,position=8/9/7,target=0/0/0,cone=30", "point,position=0.5/2/-0.5", "point,position=20/9/7",
            "rect,position=0/6/0,target=0/0/0", "rect,position=1/2/0.5,target=3/0/1", "disk,position=-1/2.5/2,target=2/1/-1"})
        for (const auto fit : {shadow::parts::Fit::uniform, shadow::parts::Fit::focused, shadow::parts::Fit::cascades,
                 shadow::parts::Fit::psm, shadow::parts::Fit::lispsm, shadow::parts::Fit::tsm, shadow::parts::Fit::cascades_warped}) {
            const auto format = fit == shadow::parts::Fit::focused ? shadow::parts::DepthFormat::d16 : shadow::parts::DepthFormat::d32;
            const shaders::LightMap map = shadow::parts::fit_light_map(
                {}, bounds, view, scene::parse_light(text, {}, bounds), {.fitting = {.fit = int(fit), .blend = 0.5f}, .format = format});
            add(map);
        }
    add(shadow::parts::fit_light_map({}, bounds, view, scene::parse_light("point,position=0.5/2/-0.5", {}, bounds),
        {.fitting = {.point_layout = int(shadow::parts::PointLayout::tetrahedron)}}));
    add(shadow::parts::fit_light_map({}, bounds, view, scene::parse_light("point,position=0.5/2/-0.5", {}, bounds),
        {.fitting = {.point_layout = int(shadow::parts::PointLayout::dual_paraboloid)}}));
    const auto results = gpu::run_glsl_cases<shaders::MapResult>(device(), "tests/gpu/light_map.comp", cases);
    size_t inside = 0, in_bands = 0, warped = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const shaders::LightMap& map = cases[i].map;
        const shaders::MapResult& r = results[i];
        SCOPED_TRACE(i);
        ASSERT_EQ(r.layer, tests::select_layer(map, cases[i].p_world));
        ASSERT_NEAR(double(r.next), tests::next_share(map, cases[i].p_world), 1e-4);
        in_bands += r.next > 0.0f ? 1 : 0;
        const shaders::LightMapLayer& layer = map.layers[r.layer];
        const tests::MapPoint m
            = layer.warped == 2 ? tests::project_paraboloid(map, r.layer, cases[i].p_world) : tests::project(layer, cases[i].p_world);
        ASSERT_NEAR(double(r.depth), m.depth, 1e-5 * double(layer.far));
        ASSERT_EQ(r.inside != 0, m.inside);
        inside += r.inside;
        if (!m.inside) continue; // behind a spot there is no uv to speak of
        warped += layer.warped;
        // matrices of warped layers have larger numbers that cancel
        const double rounding = layer.warped ? 2e-5 : 1e-5;
        ASSERT_NEAR(double(r.uv.x), m.uv.x, rounding);
        ASSERT_NEAR(double(r.uv.y), m.uv.y, rounding);
        ASSERT_NEAR(double(r.z), m.z, 1e-5);
        ASSERT_NEAR(double(r.stored), tests::stored_from_depth(layer, m.depth), 1e-5);
        ASSERT_NEAR(double(r.stored), double(r.z), 1e-5);
        // nearer the light than the receiver, by no more than the format's step or a hundred-thousandth: else contact shadows float
        ASSERT_GT(r.reference, r.stored);
        ASSERT_LE(r.reference, std::max(r.stored, 0.0f) * (1.0f + 1e-5f) + (layer.perspective ? 0.0f : 1.1e-6f) + map.depth_step * 1.01f);
        ASSERT_NEAR(double(r.linear), m.depth, 2e-5 * double(layer.far));
        for (int k = 0; k < 2; ++k)
            ASSERT_NEAR(double(r.texel[k]), m.texel[k], 1e-4 * m.texel[k] + 1e-5 * double(layer.texel_metres * layer.far));
    }
    EXPECT_GT(inside, cases.size() / 2);
    EXPECT_GT(warped, 1000u);
    EXPECT_LT(inside, cases.size() - 200);
    EXPECT_GT(in_bands, 10u);
}

} // namespace
} // namespace gnomon
