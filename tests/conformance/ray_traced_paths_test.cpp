// SPDX-License-Identifier: Apache-2.0
// Devices differ in how they trace: some have ray queries, some ray-tracing pipelines only, some neither.
#include "lab/render.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

base::Picture traced(gpu::Device& device, const char* scene, const char* light)
{
    const lab::Stage stage = lab::open_stage({.scene = scene, .lights = {light}, .size = {160, 90}});
    shadow::SceneGpu on_device(device, stage.scene);
    return lab::render(device, on_device, stage, lab::parse_choice("ray_traced:samples=4"), {.lit = false}).images.front();
}

TEST(RayTracedPaths, PipelinesSeeWhatQueriesSee)
{
    const auto queries = gpu::Device::open({.validation = true});
    const auto pipelines = gpu::Device::open({.validation = true, .without = {"VK_KHR_ray_query"}});
    if (!queries->info().ray_query || !pipelines->info().ray_tracing_pipeline)
        GTEST_SKIP() << "the device has not both ray queries and ray-tracing pipelines";
    ASSERT_FALSE(pipelines->info().ray_query);
    for (const char* scene : {"contact", "fence"}) // fence: alpha masks, any-hit shaders
        for (const char* light : {"directional,elevation=40,azimuth=120,angle=0", "disk,position=2/6/2,target=0/0/0,radius=0.5"})
            EXPECT_EQ(traced(*queries, scene, light).values, traced(*pipelines, scene, light).values) << scene << " under " << light;
    EXPECT_TRUE(queries->validation_errors().empty());
    EXPECT_TRUE(pipelines->validation_errors().empty());
}

TEST(RayTracedPaths, ADeviceWithoutRaysIsRefusedWithAReason)
{
    const auto device = gpu::Device::open({.without = {"VK_KHR_ray_query", "VK_KHR_ray_tracing_pipeline"}});
    EXPECT_NE(
        shadow::technique("ray_traced").unavailable(*device).find("neither ray queries nor ray-tracing pipelines"), std::string::npos);
}

} // namespace
} // namespace gnomon
