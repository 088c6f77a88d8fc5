// SPDX-License-Identifier: Apache-2.0
// Stochastic transparency of per_triangle_volumes, by its means and its strata.
#include "per_triangle_fixture.h"

#include <memory>

namespace gnomon {
namespace {

using namespace per_triangle_mode;

/// Frames of one still picture: the frame's number is the only seed.
class PerTriangleStochastic : public PerTriangleTest {
protected:
    static constexpr gpu::Size size{40, 30};
    inline static const scene::Camera near{.eye = {2, 2.5f, 2.5f}, .target = {0, 0, 0}};
    static std::vector<std::vector<float>> frames(const scene::Scene& s, const char* text, double samples, uint32_t count)
    {
        const scene::Light light = scene::parse_light(text, {}, s.bounds());
        const scene::View view = scene::make_view(near, size, s.bounds());
        shadow::ParamValues params(technique_per_triangle_volumes.params());
        params.set("mode", stochastic), params.set("samples", samples), params.set("texture_level", 1.0);
        shadow::SceneGpu scene(device(), s);
        gpu::Image out = image("out", shadow::output_format(technique_per_triangle_volumes, params.bytes(), light), size);
        const std::unique_ptr<shadow::Technique> technique = technique_per_triangle_volumes.create(device());
        std::vector<std::vector<float>> result;
        for (uint32_t frame = 0; frame < count; ++frame) {
            gpu::PassList passes(device());
            const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view, {.material = false});
            technique->record(passes, {s, view, light, scene, g, passes.import(out), frame}, params.bytes());
            device().submit(std::move(passes));
            result.push_back(device().read_back(out).values);
        }
        return result;
    }
};

/// The mean over 256 seeds is the grey transmittance, as far as chance allows: of each pixel, of all together, and of neighbours, which
/// would stray together if their numbers were related.
TEST_F(PerTriangleStochastic, TheMeanOverSeedsIsTheTransmittance)
{
    constexpr uint32_t count = 256;
    const scene::Scene s = cards(scene::AlphaMode::blend, 8, false);
    const char* light = "sun,elevation=70,azimuth=20,angle=0";
    const std::vector<float> exact = draw(s, near, size, light, {{"mode", textured}, {"texture_level", 1}});
    const std::vector<std::vector<float>> got = frames(s, light, 0, count);
    EXPECT_EQ(got[3], frames(s, light, 0, 4)[3]);
    EXPECT_NE(got[3], got[4]);
    double sum = 0, variance = 0, chi = 0, together = 0;
    size_t beyond = 0, random = 0;
    double last = 0;
    for (size_t i = 0; i < exact.size(); i += 4) {
        double mean_got = 0;
        for (const std::vector<float>& frame : got) {
            EXPECT_TRUE(frame[i] == 0.0f || frame[i] == 1.0f);
            mean_got += double(frame[i]) / count;
        }
        const double p = double(exact[i]), sigma = std::sqrt(p * (1 - p) / count);
        if (sigma < 1e-3) {
            EXPECT_NEAR(mean_got, p, 0.02);
            continue;
        }
        const double off = (mean_got - p) / sigma;
        beyond += std::abs(off) > 3;
        sum += mean_got - p, variance += sigma * sigma, chi += off * off, together += off * last;
        last = off;
        ++random;
    }
    ASSERT_GT(random, 150u);
    EXPECT_LE(double(beyond), 0.0027 * double(random) + 3 * std::sqrt(0.0027 * double(random)));
    EXPECT_LT(std::abs(sum), 3 * std::sqrt(variance));
    EXPECT_LT(std::abs(chi - double(random)), 3 * std::sqrt(2 * double(random)));
    EXPECT_LT(std::abs(together), 3 * std::sqrt(double(random)));
}

/// Of a pixel's 4 or 16 samples under a pane of one quarter, each is in a stratum of its own: exactly a quarter are dark.
TEST_F(PerTriangleStochastic, TheSamplesOfAPixelAreStratified)
{
    scene::Scene s = panes({blended(vec4(0, 0, 0, 0.25f))});
    s.materials[1].base_color = vec4(1, 1, 1, 0.25f);
    const char* light = "sun,elevation=80,azimuth=10,angle=0";
    for (const double samples : {1.0, 2.0}) {
        const std::vector<std::vector<float>> got = frames(s, light, samples, 4);
        const std::vector<float> exact = draw(s, near, size, light, {{"mode", rgb}, {"samples", samples}});
        size_t under = 0, diagonal = 0; // where two triangles share a pixel's samples, each draws its own numbers
        for (const std::vector<float>& frame : got)
            for (size_t i = 0; i < exact.size(); i += 4) {
                if (std::abs(exact[i] - 0.75f) > 1e-5f) continue;
                ++under;
                diagonal += frame[i] != 0.75f;
            }
        EXPECT_GT(under, 1000u);
        EXPECT_LT(double(diagonal), 0.05 * double(under));
    }
}

} // namespace
} // namespace gnomon
