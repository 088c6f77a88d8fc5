// SPDX-License-Identifier: Apache-2.0
// What needs ray queries where there are none: shadow volumes.
#include "lab/render.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(HybridWithoutRays, ShadowVolumesTakeTheirPlace)
{
    const lab::Stage stage
        = lab::open_stage({.scene = "contact", .lights = {"spot,position=3.2/4.5/2.6,target=0/0.3/0,cone=64,radius=0"}, .size = {160, 90}});
    const auto draw = [&](gpu::Device& device, const char* technique) {
        shadow::SceneGpu scene(device, stage.scene);
        return lab::render(device, scene, stage, lab::parse_choice(technique), {.lit = false}).images.front().values;
    };
    const auto with = gpu::Device::open({.validation = true});
    const auto without = gpu::Device::open({.validation = true, .without = {"VK_KHR_ray_query"}});
    ASSERT_FALSE(without->info().ray_query);
    EXPECT_EQ(shadow::refusal(shadow::technique("hybrid_map_volume"), *without, stage.lights[0]), "");
    EXPECT_EQ(draw(*without, "hybrid_map_volume"), draw(*with, "hybrid_map_volume:exact=volumes"));
    EXPECT_TRUE(with->validation_errors().empty());
    EXPECT_TRUE(without->validation_errors().empty());
}

} // namespace
} // namespace gnomon
