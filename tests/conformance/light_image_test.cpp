// SPDX-License-Identifier: Apache-2.0
// A light with an image through the whole laboratory: truth in colour, techniques that answer in colour, and others that answer in grey.
#include "lab/compare.h"
#include "lab/slice.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<gpu::Device> open_device()
{
    const char* name = std::getenv("GNOMON_DEVICE");
    return gpu::Device::open({name ? name : "", true});
}

constexpr const char* light = "rect,position=4/7/4,target=0/0.5/0,width=2.5,height=1.5,image=window";

std::vector<std::string> colored_techniques()
{
    std::vector<std::string> out;
    for (const shadow::TechniqueInfo* info : shadow::techniques())
        if (info->textured) out.emplace_back(info->id);
    return out;
}

TEST(LightImage, TechniquesOfItsColoursComeNearTheTruth)
{
    const auto device = open_device();
    lab::CompareOptions options;
    options.stage = {.scene = "balls", .lights = {light}, .size = {120, 80}};
    options.techniques = colored_techniques();
    ASSERT_GE(options.techniques.size(), 2u);
    options.techniques.emplace_back("pcss");
    options.reference = "light_sampling";
    options.repeats = 1;
    const fs::path folder = fs::temp_directory_path() / ("gnomon_light_image_" + std::to_string(getpid()));
    options.folder = folder, options.truth_cache = folder / "truth";
    const lab::Comparison comparison = lab::compare(*device, options);
    double grey = 0;
    for (const lab::Run& run : comparison.runs)
        if (run.technique == "pcss") grey = run.metrics.at("mae");
    for (const lab::Run& run : comparison.runs) {
        EXPECT_EQ(run.skipped, "");
        EXPECT_EQ(run.reference, "light_sampling") << run.reference_refused;
        if (run.technique == "pcss") continue;
        EXPECT_LT(run.metrics.at("mae"), 0.02) << run.technique;
        EXPECT_LT(run.metrics.at("mae"), 0.6 * grey) << run.technique;
    }
    EXPECT_TRUE(device->validation_errors().empty());
    fs::remove_all(folder);
}

TEST(LightImage, SlicesAreColoured)
{
    const auto device = open_device();
    const lab::Stage stage = lab::open_stage({.scene = "balls", .lights = {light}, .size = {60, 40}});
    shadow::SceneGpu scene(*device, stage.scene);
    const lab::Slice slice = lab::make_slice(stage, {});
    const base::Picture truth = lab::slice_truth(stage, slice, truth::Quantity::visibility, 64);
    ASSERT_EQ(truth.channels, 3);
    for (const std::string& id : colored_techniques()) {
        const base::Picture image = lab::slice_image(*device, scene, stage, slice, lab::parse_choice(id));
        ASSERT_EQ(image.channels, 3) << id;
        double error = 0;
        for (size_t i = 0; i < image.values.size(); ++i) error += std::abs(double(image.values[i] - truth.values[i]));
        EXPECT_LT(error / double(image.values.size()), 0.05) << id;
    }
    EXPECT_EQ(lab::slice_image(*device, scene, stage, slice, lab::parse_choice("pcss")).channels, 1);
}

} // namespace
} // namespace gnomon
