// SPDX-License-Identifier: Apache-2.0
// The negative control stays wrong: each test here fails once blurred depth gets as good as percentage-closer filtering.
#include "technique_fixture.h"

#include <algorithm>
#include <cmath>
#include <set>

extern const gnomon::shadow::TechniqueInfo technique_blurred_depth;
extern const gnomon::shadow::TechniqueInfo technique_pcf;

namespace gnomon {
namespace {

constexpr double receiver_plane = 3, smooth = 1;

class BlurredDepth : public gpu::TechniqueTest {
protected:
    /// Visibility across the edge of half_shadowed() at x = 0, from -0.5 to 0.5 m.
    static std::vector<float> edge(const shadow::TechniqueInfo& info, Values values)
    {
        values.insert(values.end(), {{"map_size", 256}, {"kernel", 9}, {"fit", 0}});
        if (&info == &technique_pcf) values.push_back({"bias", receiver_plane});
        const scene::Camera camera = gpu::camera_above({0, 0, 0.3f}, 0.5f, 0.5f / 64); // 256 x 4 pixels
        return draw(info, gpu::half_shadowed(), camera, {256, 4}, "sun,elevation=90,angle=0", values);
    }
};

TEST_F(BlurredDepth, IsStillBinaryAndWidensTheShadow)
{
    const std::vector<float> blurred = edge(technique_blurred_depth, {}), filtered = edge(technique_pcf, {});
    const std::set<float> levels(blurred.begin(), blurred.end());
    EXPECT_EQ(levels, (std::set<float>{0.0f, 1.0f})) << "no grey between";
    EXPECT_GT(std::set<float>(filtered.begin(), filtered.end()).size(), 20u);

    // Where any texel of the window is the caster's, the mean is nearer than the floor: the shadow grows by half a window, and a
    // strip of that width is wrong. The ramp of percentage-closer filtering is wrong by two triangles of half that area together.
    const auto wrong_metres = [](const std::vector<float>& v) {
        double sum = 0;
        for (size_t x = 0; x < 256; ++x) sum += std::abs(double(v[x]) - (x < 128 ? 0.0 : 1.0)) / 256;
        return sum;
    };
    const double texel = 8.0 / (256 - 2 * 5.5);
    EXPECT_NEAR(wrong_metres(filtered), 9 * texel / 4, 0.1 * texel);
    EXPECT_NEAR(wrong_metres(blurred), 9 * texel / 2, 0.7 * texel);
    EXPECT_GT(wrong_metres(blurred), 1.6 * wrong_metres(filtered));
}

TEST_F(BlurredDepth, SmoothComparisonLeaksUnderNearOccluders)
{
    // a sheet low over the floor at x = -2, one a metre above it at x = 2
    scene::Scene s = gpu::floor_scene(4);
    gpu::add_quad(s, {-2, 0.1f, 0}, 1);
    gpu::add_quad(s, {2, 1, 0}, 1);
    const auto under = [&](float x, const shadow::TechniqueInfo& info, Values values) {
        values.insert(values.end(), {{"map_size", 256}, {"kernel", 9}, {"fit", 0}});
        return mean(draw(info, s, gpu::camera_above({x, 0, 0}, 0.05f, 0.1f), {8, 8}, "sun,elevation=90,angle=0", values));
    };
    const Values soft{{"compare", smooth}, {"softness", 0.5}};
    for (const float x : {-2.0f, 2.0f}) {
        EXPECT_EQ(under(x, technique_pcf, {{"bias", receiver_plane}}), 0.0);
        EXPECT_EQ(under(x, technique_blurred_depth, {}), 0.0);
    }
    EXPECT_EQ(under(2, technique_blurred_depth, soft), 0.0);
    // 1 - smoothstep(0, 0.5, 0.1): nine tenths of the light comes through an opaque sheet
    EXPECT_NEAR(under(-2, technique_blurred_depth, soft), 0.896, 0.01);
}

} // namespace
} // namespace gnomon
