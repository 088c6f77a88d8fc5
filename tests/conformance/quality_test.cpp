// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/quality.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

scene::Light light_of(const char* text) { return scene::parse_light(text, {}, Bounds{vec3(-1), vec3(1)}); }

TEST(QualityChoice, FollowsTheLightAndTheDevice)
{
    const auto device = gpu::Device::open({.validation = true});
    const auto rayless = gpu::Device::open({.without = {"VK_KHR_ray_query", "VK_KHR_ray_tracing_pipeline"}});
    for (const char* text :
        {"sun,angle=0", "sun,angle=2", "spot,radius=0", "spot,radius=0.2", "point,radius=0", "point,radius=0.2", "rect", "disk"})
        for (const char* level : {"low", "medium", "high", "exact"}) {
            SCOPED_TRACE(std::string(text) + " " + level);
            const scene::Light light = light_of(text);
            for (const gpu::Device* d : {device.get(), rayless.get()}) {
                const lab::Choice choice = lab::quality_choice(level, *d, {&light, 1});
                EXPECT_EQ(shadow::refusal(*choice.info, *d, light), "");
                EXPECT_EQ(choice.info->soft, light.soft());
            }
        }
    const scene::Light panel = light_of("rect");
    EXPECT_EQ(lab::quality_choice("exact", *device, {&panel, 1}).info->id, "ray_traced");
    EXPECT_EQ(lab::quality_choice("exact", *rayless, {&panel, 1}).info->id, "light_sampling");
}

std::string sentence(const gpu::Device& device, const char* level, const std::vector<scene::Light>& lights)
{
    try {
        lab::quality_choice(level, device, lights);
    } catch (const base::Error& e) {
        return e.what();
    }
    return "";
}

TEST(QualityChoice, IsOneTechniqueForOnePicture)
{
    const auto device = gpu::Device::open({});
    EXPECT_EQ(sentence(*device, "low", {light_of("rect"), light_of("disk")}), "");
    EXPECT_NE(sentence(*device, "low", {light_of("rect"), light_of("spot,radius=0")}).find("render them one at a time"), std::string::npos);
    EXPECT_NE(sentence(*device, "best", {light_of("rect")}).find("unknown quality 'best'"), std::string::npos);
    EXPECT_NE(sentence(*device, "low", {}).find("name one with --light"), std::string::npos);
}

} // namespace
} // namespace gnomon
