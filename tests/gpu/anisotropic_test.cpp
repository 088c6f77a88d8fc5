// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "window_cases.h"

#include "shadow/parts/pyramid.h"

#include <numbers>

namespace gnomon {
namespace {

using namespace tests;
namespace parts = shadow::parts;
using dvec2 = glm::dvec2;
constexpr int side = 128;

class Anisotropic : public gpu::DeviceTest {
protected:
    static std::vector<shaders::FootprintResult> run(const Layers& layers, const std::vector<shaders::FootprintCase>& cases)
    {
        const base::Size size = layers[0].size;
        gpu::Image mips
            = image("mips", upload_layers(device(), layers).desc().format, size, uint32_t(layers.size()), parts::pyramid_levels(size));
        for (uint32_t i = 0; i < layers.size(); ++i) device().upload(mips, std::as_bytes(std::span(layers[i].values)), i);
        gpu::PassList list(device());
        const gpu::ImageId id = list.import(mips);
        parts::fill_mean_pyramid(list, id);
        return run_image_cases<shaders::FootprintResult>(
            std::move(list), "tests/gpu/anisotropic.comp", cases, {{id, gpu::Use::sample, gpu::Sampler::linear_clamp}});
    }
};

/// Footprints in texels, of a square image, whose middles keep off the rim.
struct Footprints {
    std::mt19937 random;
    std::uniform_real_distribution<float> unit{0.0f, 1.0f};
    explicit Footprints(uint32_t seed)
        : random(seed)
    {
    }
    shaders::FootprintCase make(vec2 dx, vec2 dy, int most = 16)
    {
        return {0, most, 0.3f + 0.4f * vec2(unit(random), unit(random)), dx / float(side), dy / float(side)};
    }
    /// Of axes `width` along `angle` and `height` across, seen as a pixel turned by `turn`.
    shaders::FootprintCase make(float width, float height, float angle, float turn)
    {
        const vec2 u(std::cos(angle), std::sin(angle)), v(-u.y, u.x);
        const auto map = [&](float t) { return width * std::cos(t) * u + height * std::sin(t) * v; };
        return make(map(turn), map(turn + std::numbers::pi_v<float> / 2));
    }
    float angle() { return 2 * std::numbers::pi_v<float> * unit(random); }
};

/// Stripes that run along `angle`, one in so many texels.
double stripes(dvec2 p, double angle, double period)
{
    return 0.5 + 0.5 * std::sin(2 * std::numbers::pi / period * (p.y * std::cos(angle) - p.x * std::sin(angle)));
}

base::Picture striped(double angle, double period)
{
    base::Picture p({side, side}, 1);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) p.at(x, y) = float(stripes({x + 0.5, y + 0.5}, angle, period));
    return p;
}

/// The mean over the parallelogram that the pixel maps to.
double brute_force(const shaders::FootprintCase& c, double angle, double period)
{
    constexpr int n = 48;
    double sum = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const dvec2 at = dvec2(c.uv) + dvec2(c.uv_dx) * ((i + 0.5) / n - 0.5) + dvec2(c.uv_dy) * ((j + 0.5) / n - 0.5);
            sum += stripes(at * double(side), angle, period);
        }
    return sum / (n * n);
}

TEST_F(Anisotropic, AxesAreTheExtremesOfTheCircle)
{
    Footprints f(1);
    std::vector<shaders::FootprintCase> cases = {f.make(vec2(4, 0), vec2(0, 2)), f.make(vec2(0, 4), vec2(2, 0)),
        f.make(vec2(3, 0), vec2(0, 3)), f.make(vec2(0), vec2(0)), f.make(vec2(5, 5), vec2(5, 5)), f.make(vec2(0, 7), vec2(0))};
    while (cases.size() < 500)
        cases.push_back(f.make(std::exp2(8 * f.unit(f.random) - 2), std::exp2(8 * f.unit(f.random) - 2), f.angle(), f.angle()));
    const auto results = run({striped(0, 8)}, cases);
    for (size_t i = 0; i < cases.size(); ++i) {
        const dvec2 dx = dvec2(cases[i].uv_dx) * double(side), dy = dvec2(cases[i].uv_dy) * double(side);
        double most = 0, least = INFINITY;
        for (int k = 0; k < 3000; ++k) {
            const double t = std::numbers::pi * k / 3000, reach = glm::length(dx * std::cos(t) + dy * std::sin(t));
            most = std::max(most, reach), least = std::min(least, reach);
        }
        const dvec2 major(results[i].major);
        ASSERT_NEAR(glm::length(major), most, 1e-5 * most + 1e-6) << i;
        ASSERT_NEAR(double(results[i].minor), least, 2e-3 * most + 1e-6) << i;
        if (most < 1.001 * least || most == 0) continue; // a circle's axes are any
        // the farthest point of the ellipse from its middle lies along the axis: its image is on it to the second order
        const dvec2 along = major / glm::length(major);
        ASSERT_NEAR(glm::dot(along, dx) * glm::dot(along, dx) + glm::dot(along, dy) * glm::dot(along, dy), most * most, 1e-4 * most * most)
            << i;
    }
}

TEST_F(Anisotropic, RoundFootprintsAreOneTrilinearFetch)
{
    Footprints f(2);
    std::vector<shaders::FootprintCase> cases;
    for (int i = 0; i < 400; ++i) {
        const float width = std::exp2(6 * f.unit(f.random) - 1);
        cases.push_back(f.make(width, width, f.angle(), f.angle()));
    }
    const auto results = run(random_layers({side, side}, 2, 1, 3), cases);
    for (size_t i = 0; i < cases.size(); ++i)
        for (int k = 0; k < 2; ++k) ASSERT_NEAR(results[i].mean[k], results[i].trilinear[k], 2e-3f) << i; // samplers have 8 bits of level
}

TEST_F(Anisotropic, ConstantsStay)
{
    Footprints f(4);
    std::vector<shaders::FootprintCase> cases;
    for (int i = 0; i < 400; ++i) {
        cases.push_back(f.make(std::exp2(12 * f.unit(f.random) - 2), std::exp2(12 * f.unit(f.random) - 2), f.angle(), f.angle()));
        cases.back().layer = i % 6, cases.back().most = 1 + i % 16;
        cases.back().uv = 3.0f * cases.back().uv - 1.0f; // over the rim too
    }
    const auto results = run(Layers(6, base::Picture({77, 45}, 4, 0.375f)), cases);
    for (size_t i = 0; i < cases.size(); ++i)
        for (int k = 0; k < 4; ++k) ASSERT_NEAR(results[i].mean[k], 0.375f, 1e-6f) << i;
}

TEST_F(Anisotropic, StripesStaySharpAlongAndBlurAcross)
{
    for (const float angle : {0.0f, 1.5708f, 0.6f, -0.9f}) {
        SCOPED_TRACE(angle);
        Footprints f(5);
        std::vector<shaders::FootprintCase> along, across;
        for (int i = 0; i < 200; ++i) {
            along.push_back(f.make(12, 1, angle, f.angle())); // any view of the same footprint, also with slanting derivatives
            across.push_back(f.make(1, 24, angle, f.angle()));
        }
        const Layers layers{striped(double(angle), 8)};
        const auto sharp = run(layers, along), blurred = run(layers, across);
        double error = 0, isotropic = 0;
        for (size_t i = 0; i < along.size(); ++i) {
            const double truth = brute_force(along[i], double(angle), 8);
            error += std::abs(double(sharp[i].mean.x) - truth), isotropic += std::abs(double(sharp[i].trilinear.x) - truth);
            EXPECT_NEAR(blurred[i].mean.x, 0.5f, 0.08f);
        }
        EXPECT_LT(error / double(along.size()), 0.06);
        EXPECT_GT(isotropic / double(along.size()), 0.2);
    }
}

TEST_F(Anisotropic, TooFewProbesBlurInsteadOfSkipping)
{
    // 64 texels across stripes of 4 with 2 probes: each as wide as 32 texels, so nothing is left of the stripes
    Footprints f(6);
    std::vector<shaders::FootprintCase> cases;
    for (int i = 0; i < 200; ++i) {
        cases.push_back(f.make(1, 64, 0, 0));
        cases.back().most = 2;
    }
    for (const auto& r : run({striped(0, 4)}, cases)) ASSERT_NEAR(r.mean.x, 0.5f, 0.02f);
}

} // namespace
} // namespace gnomon
