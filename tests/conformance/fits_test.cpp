// SPDX-License-Identifier: Apache-2.0
// Every technique that takes a map's fit as a parameter, with every fit.
#include "lab/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace gnomon {
namespace {

std::vector<const shadow::TechniqueInfo*> fitted_techniques()
{
    std::vector<const shadow::TechniqueInfo*> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        for (const shadow::ParamInfo& p : info->params().fields)
            if (p.name == "cascades") out.push_back(info);
    return out;
}

class Fits : public testing::TestWithParam<const shadow::TechniqueInfo*> { };

// A hall seen along its length: a single map's texels are far too coarse near the eye.
TEST_P(Fits, SeveralLayersAndWarpsAreNearerToTheTruthThanOneFocusedLayer)
{
    const char* name = std::getenv("GNOMON_DEVICE");
    const auto device = gpu::Device::open({.name = name ? name : "", .validation = true});
    const std::string id(GetParam()->id);
    // Not above so much of the focused layer's error. They want texels of one width, and take a warp's for none (their pages).
    const bool unwarped = id == "back_projection" || id == "occlusion_textures";
    const std::vector<std::pair<std::string, double>> fits{{"cascades:stable_cascades=0", 0.8}, {"cascades:stable_cascades=1", 0.9},
        {"cascades_warped", 0.8}, {"lispsm", unwarped ? 1.0 : 0.85}, {"psm", unwarped ? 1.0 : 0.9}, {"tsm", 1.0}, {"sdsm", 0.8}};
    lab::CompareOptions options;
    options.stage = {.scene = "duelling_frusta",
        .lights = {GetParam()->soft ? "sun,elevation=35,azimuth=60,angle=1" : "sun,elevation=35,azimuth=60,angle=0"},
        .size = {240, 135}};
    const std::string map = id + ":map_size=256:fit=";
    options.techniques = {map + "focused"};
    for (const auto& [fit, bound] : fits) options.techniques.push_back(map + fit);
    options.truth_samples = GetParam()->soft ? 16 : 1;
    options.repeats = 1;
    const lab::Comparison result = lab::compare(*device, options);
    ASSERT_EQ(result.runs.size(), fits.size() + 1);
    const double focused = result.runs[0].metrics.at("mae");
    for (size_t i = 0; i < fits.size(); ++i)
        EXPECT_LE(result.runs[i + 1].metrics.at("mae"), fits[i].second * focused) << fits[i].first << ", focused: " << focused;
    EXPECT_LE(result.runs.back().metrics.at("mae"), 1.02 * result.runs[1].metrics.at("mae")) << "sdsm, tight cascades";
    EXPECT_TRUE(device->validation_errors().empty());
}

INSTANTIATE_TEST_SUITE_P(Techniques, Fits, testing::ValuesIn(fitted_techniques()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon
