// SPDX-License-Identifier: Apache-2.0
// Every technique with a light map, with a tetrahedron's or two paraboloids' layers around a point light instead of a cube's.
#include "lab/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon {
namespace {

std::vector<const shadow::TechniqueInfo*> techniques_with_layouts()
{
    std::vector<const shadow::TechniqueInfo*> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        if (info->params().find("point_layout")) out.push_back(info);
    return out;
}

class PointLayouts : public testing::TestWithParam<const shadow::TechniqueInfo*> {
protected:
    void SetUp() override
    {
        const char* name = std::getenv("GNOMON_DEVICE");
        device_ = gpu::Device::open({.name = name ? name : "", .validation = true});
    }
    void TearDown() override { EXPECT_TRUE(device_->validation_errors().empty()); }

    base::Picture draw(const lab::Stage& stage, const std::string& choice) const
    {
        shadow::SceneGpu scene(*device_, stage.scene);
        return lab::render(*device_, scene, stage, lab::parse_choice(choice), {.lit = false}).images.front();
    }

    std::unique_ptr<gpu::Device> device_;
};

/// An eye in the light sees nothing that is shadowed. A seam between two layers would be, or a filter that looks over a layer's rim.
TEST_P(PointLayouts, NoSeamIsSeenFromTheLight)
{
    const std::string id(GetParam()->id);
    for (const char* target : {"1/0.2/1", "-1/0.5/0.4", "0.1/-1/0.3", "-0.3/-0.4/-1"}) {
        const lab::Stage stage
            = lab::open_stage({"closed_box", {}, "eye=0/0/0,target=0/0/1", {"point,position=0/1.5/0.4,radius=0"}, {96, 96}});
        lab::Stage inside = stage;
        vec3 at;
        ASSERT_EQ(std::sscanf(target, "%f/%f/%f", &at.x, &at.y, &at.z), 3);
        inside.camera.eye = {0, 1.5f, 0.4f}, inside.camera.target = inside.camera.eye + at, inside.camera.fov_y = glm::radians(100.0f);
        inside.view = scene::make_view(inside.camera, inside.view.size, inside.bounds);
        const auto dark = [&](const char* map) {
            const base::Picture image = draw(inside, id + map);
            size_t count = 0;
            for (size_t i = 0; i < image.size.area(); ++i) count += image.values[i * size_t(image.channels)] < 0.75f;
            return count;
        };
        // what a cube of such texels leaves are the edges of the things in the box
        const size_t cube = dark(":map_size=433:point_layout=cube");
        EXPECT_LE(dark(":map_size=1024:point_layout=tetrahedron"), 2 * cube + 25) << target;
        EXPECT_LE(dark(":map_size=1024:point_layout=dual_paraboloid"), 2 * cube + 25) << target;
    }
}

TEST_P(PointLayouts, OthersAreAsNearToTheTruthAsACubeOfTheirTexels)
{
    const std::string id(GetParam()->id);
    lab::CompareOptions options;
    options.stage = {.scene = "contact",
        .lights = {GetParam()->soft ? "point,position=1.5/3.2/1.8,radius=0.2" : "point,position=1.5/3.2/1.8,radius=0"},
        .size = {240, 135}};
    options.techniques = {id + ":map_size=400:point_layout=cube", id + ":map_size=944:point_layout=tetrahedron",
        id + ":map_size=944:point_layout=dual_paraboloid"};
    options.truth_samples = GetParam()->soft ? 16 : 1;
    options.repeats = 1;
    const lab::Comparison result = lab::compare(*device_, options);
    ASSERT_EQ(result.runs.size(), 3u);
    const double cube = result.runs[0].metrics.at("mae"), tetrahedron = result.runs[1].metrics.at("mae"),
                 paraboloids = result.runs[2].metrics.at("mae");
    RecordProperty("cube", std::to_string(cube));
    RecordProperty("tetrahedron", std::to_string(tetrahedron));
    RecordProperty("paraboloids", std::to_string(paraboloids));
    EXPECT_LT(paraboloids, 1.2 * cube + 0.001);
    EXPECT_LT(tetrahedron, 1.2 * cube + 0.001);
    EXPECT_GT(tetrahedron, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, PointLayouts, testing::ValuesIn(techniques_with_layouts()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon
