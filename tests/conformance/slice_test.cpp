// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "lab/slice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace gnomon {
namespace {

gpu::Device& device()
{
    const char* name = std::getenv("GNOMON_DEVICE");
    static const std::unique_ptr<gpu::Device> shared = gpu::Device::open({name ? name : "", true});
    return *shared;
}

struct Difference {
    double wrong, mae, dark; ///< dark: of the truth
};

Difference compare(const std::string& scene_name, const std::string& light, const std::string& technique, int samples)
{
    const lab::Stage stage = lab::open_stage({scene_name, {}, "", {light}, {160, 90}});
    shadow::SceneGpu scene(device(), stage.scene);
    const lab::Slice slice = lab::make_slice(stage, {});
    const base::Picture image = lab::slice_image(device(), scene, stage, slice, lab::parse_choice(technique)),
                        truth = lab::slice_truth(stage, slice, truth::Quantity::visibility, samples);
    Difference out{};
    for (size_t i = 0; i < image.values.size(); ++i) {
        const double d = std::abs(double(image.values[i]) - double(truth.values[i]));
        out.wrong += d > 0.5, out.mae += d, out.dark += truth.values[i] < 0.5f;
    }
    const double count = double(image.values.size());
    return {out.wrong / count, out.mae / count, out.dark / count};
}

TEST(Slice, RayTracedIsTheTruthInTheAirToo)
{
    if (const std::string reason = shadow::technique("ray_traced").unavailable(device()); !reason.empty()) GTEST_SKIP() << reason;
    for (const char* light :
        {"sun,elevation=40,azimuth=120,angle=0", "spot,position=3/4/2,target=0/0/0,cone=60,radius=0", "point,position=1/3/2,radius=0"})
        for (const char* scene : {"contact", "balls"}) {
            const Difference d = compare(scene, light, "ray_traced", 1);
            EXPECT_LT(d.wrong, 5e-4) << scene << ", " << light;
            EXPECT_GT(d.dark, 0.02) << scene << ", " << light;
        }
    EXPECT_LT(compare("balls", "rect,position=2/4/1,target=0/0/0,width=1,height=1", "ray_traced:samples=64", 64).mae, 0.01);
    EXPECT_TRUE(device().validation_errors().empty());
}

TEST(Slice, ShadowMapIsNearIt)
{
    const Difference d = compare("balls", "sun,elevation=40,azimuth=120,angle=0", "shadow_map", 1);
    EXPECT_LT(d.mae, 0.03);
    EXPECT_GT(d.dark, 0.02);
}

TEST(Slice, RefusesWhatTheTechniqueRefuses)
{
    const lab::Stage stage = lab::open_stage({"balls", {}, "", {"rect,position=2/4/1"}, {32, 18}});
    shadow::SceneGpu scene(device(), stage.scene);
    EXPECT_THROW(lab::slice_image(device(), scene, stage, lab::make_slice(stage, {}), lab::parse_choice("shadow_map")), base::Error);
}

} // namespace
} // namespace gnomon
