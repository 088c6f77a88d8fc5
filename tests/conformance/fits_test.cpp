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
TEST_P(Fits, CascadesAreNearerToTheTruthThanOneLayer)
{
    const char* name = std::getenv("GNOMON_DEVICE");
    const auto device = gpu::Device::open({.name = name ? name : "", .validation = true});
    const std::string id(GetParam()->id);
    lab::CompareOptions options;
    options.stage = {.scene = "duelling_frusta",
        .lights = {GetParam()->soft ? "sun,elevation=35,azimuth=60,angle=1" : "sun,elevation=35,azimuth=60,angle=0"},
        .size = {240, 135}};
    const std::string map = id + ":map_size=256:fit=";
    options.techniques = {map + "focused", map + "cascades:stable_cascades=0", map + "cascades:stable_cascades=1"};
    options.truth_samples = GetParam()->soft ? 16 : 1;
    options.repeats = 1;
    const lab::Comparison result = lab::compare(*device, options);
    ASSERT_EQ(result.runs.size(), 3u);
    const auto error = [&](size_t run) { return result.runs[run].metrics.at("mae"); };
    EXPECT_LT(error(1), 0.8 * error(0));
    EXPECT_LT(error(2), 0.9 * error(0));
    EXPECT_TRUE(device->validation_errors().empty());
}

INSTANTIATE_TEST_SUITE_P(Techniques, Fits, testing::ValuesIn(fitted_techniques()), [](const auto& p) { return std::string(p.param->id); });

} // namespace
} // namespace gnomon
