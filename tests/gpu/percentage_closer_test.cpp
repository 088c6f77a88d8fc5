// SPDX-License-Identifier: Apache-2.0
#include "device_fixture.h"
#include "glsl_function.h"
#include "percentage_closer.shared.h"
#include "tests/light_map_twin.h"

#include "shadow/parts/light_map.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace gnomon {
namespace {

using shaders::FilterCase;
constexpr int map_side = 64;
enum Reconstruct { nearest, bilinear, bicubic };

/// Depth at texel (x, y).
using Depths = std::function<float(int, int)>;

class PercentageCloser : public gpu::DeviceTest {
protected:
    static std::vector<float> filter(const Depths& depth, const std::vector<FilterCase>& cases)
    {
        std::vector<float> texels;
        for (int y = 0; y < map_side; ++y)
            for (int x = 0; x < map_side; ++x) texels.push_back(depth(x, y));
        gpu::Image map = image("map", VK_FORMAT_D32_SFLOAT, {map_side, map_side});
        device().upload(map, std::as_bytes(std::span(texels)));
        gpu::Buffer in = storage("cases", std::span<const FilterCase>(cases)), out = storage<float>("results", cases.size());
        gpu::PassList list(device());
        gpu::ComputePass pass;
        pass.name = "filter";
        pass.program = &device().compute_program("tests/gpu/percentage_closer.comp");
        const gpu::ImageId id = list.import(map);
        pass.bindings = {{list.import(in), gpu::Use::load}, {list.import(out), gpu::Use::store},
            gpu::Binding(id, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
            gpu::Binding(id, gpu::Use::sample, gpu::Sampler::compare_linear).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
        pass.constants = uint32_t(cases.size());
        pass.threads = {uint32_t(cases.size()), 1, 1};
        list.compute(std::move(pass));
        device().submit(std::move(list));
        return values<float>(out);
    }
};

/// The filters as they are defined: a plain sum over taps, each a plain sum over its texels, in double.
struct Twin {
    const Depths& depth;
    const FilterCase& k;

    double lit(int x, int y) const
    {
        const double dx = x + 0.5 - double(k.at.x), dy = y + 0.5 - double(k.at.y);
        const double z = double(k.z) + double(k.slope.x) * dx + double(k.slope.y) * dy + double(k.cone) * std::hypot(dx, dy);
        const int cx = std::clamp(x, 0, map_side - 1), cy = std::clamp(y, 0, map_side - 1); // as a clamping sampler
        return double(depth(cx, cy)) <= std::max(z, 0.0) ? 1.0 : 0.0;
    }

    /// B-spline of order 0, 1 or 3 centred on 0.
    static double spline(double x, int reconstruct)
    {
        x = std::abs(x);
        if (reconstruct == bilinear) return std::max(0.0, 1.0 - x);
        if (x >= 2) return 0;
        return x >= 1 ? std::pow(2 - x, 3) / 6 : (4 - 6 * x * x + 3 * x * x * x) / 6;
    }

    double tap(double x, double y) const
    {
        if (k.reconstruct == nearest) return lit(int(std::floor(x)), int(std::floor(y)));
        double sum = 0;
        for (int j = int(std::floor(y)) - 2; j <= int(std::floor(y)) + 2; ++j)
            for (int i = int(std::floor(x)) - 2; i <= int(std::floor(x)) + 2; ++i)
                sum += spline(x - i - 0.5, k.reconstruct) * spline(y - j - 0.5, k.reconstruct) * lit(i, j);
        return sum;
    }

    double separable() const
    {
        double sum = 0, weights = 0;
        for (int j = 0; j < k.n; ++j)
            for (int i = 0; i < k.n; ++i) {
                const double x = i - 0.5 * (k.n - 1), y = j - 0.5 * (k.n - 1), sigma = k.n / 6.0;
                const double w = k.gaussian ? std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)) : 1.0;
                sum += w * tap(double(k.at.x) + x, double(k.at.y) + y), weights += w;
            }
        return sum / weights;
    }
};

TEST_F(PercentageCloser, StraightEdgeUnderBoxIsARampAsWideAsTheKernel)
{
    for (const bool vertical : {false, true}) {
        const Depths edge = [vertical](int x, int y) { return (vertical ? y : x) < 32 ? 0.8f : 0.0f; };
        std::vector<FilterCase> cases;
        for (const int n : {1, 2, 3, 4, 9, 16, 31})
            for (float u = 12.03f; u < 52.0f; u += 0.37f)
                for (const int reconstruct : {nearest, bilinear})
                    cases.push_back({.at = vertical ? vec2(31.7f, u) : vec2(u, 31.7f), .z = 0.5f, .n = n, .reconstruct = reconstruct});
        const std::vector<float> got = filter(edge, cases);
        for (size_t i = 0; i < cases.size(); ++i) {
            const double u = double(vertical ? cases[i].at.y : cases[i].at.x), n = cases[i].n;
            // n overlapping tents, each clamp(x - 31.5, 0, 1), add up to one ramp; nearest taps step over texels
            const double ramp = std::clamp((u - 32 + n / 2) / n, 0.0, 1.0);
            const double stairs = std::clamp((std::floor(u + n / 2 - 0.5) - 31) / n, 0.0, 1.0);
            ASSERT_NEAR(double(got[i]), cases[i].reconstruct == bilinear ? ramp : stairs, 2e-6) << "u " << u << ", n " << n;
        }
    }
}

TEST_F(PercentageCloser, GathersAreThePlainSumOverTaps)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<float> noise(map_side * map_side);
    for (float& v : noise) v = unit(random) < 0.2f ? 0.0f : unit(random);
    const Depths depth = [&](int x, int y) { return noise[size_t(y * map_side + x)]; };
    std::vector<FilterCase> cases;
    for (const int n : {1, 2, 3, 6, 9, 14})
        for (const int reconstruct : {nearest, bilinear, bicubic})
            for (const int gaussian : {0, 1})
                for (int i = 0; i < 12; ++i) {
                    FilterCase k{.at = vec2(unit(random), unit(random)) * float(map_side),
                        .z = unit(random),
                        .n = n,
                        .gaussian = gaussian,
                        .reconstruct = reconstruct};
                    if (i % 3 == 1) k.slope = 0.1f * vec2(unit(random) - 0.5f, unit(random) - 0.5f);
                    if (i % 3 == 2) k.cone = 0.03f * unit(random);
                    cases.push_back(k);
                }
    const std::vector<float> got = filter(depth, cases);
    double spread = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const double want = Twin{depth, cases[i]}.separable();
        ASSERT_NEAR(double(got[i]), want, 1e-5) << "case " << i << " n " << cases[i].n << " reconstruct " << cases[i].reconstruct;
        spread = std::max(spread, std::min(want, 1 - want));
    }
    EXPECT_GT(spread, 0.4) << "the cases must not all be wholly lit or dark";
}

TEST_F(PercentageCloser, TapsAgreeWithTheHardware)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<float> noise(map_side * map_side);
    for (float& v : noise) v = unit(random);
    const Depths depth = [&](int x, int y) { return noise[size_t(y * map_side + x)]; };
    std::vector<FilterCase> by_hand, hardware;
    for (int i = 0; i < 400; ++i) {
        FilterCase k{.kind = CASE_TAP,
            .at = 4.0f + 50.0f * vec2(unit(random), unit(random)),
            .z = unit(random),
            .reconstruct = 1,
            .d = 6.0f * vec2(unit(random) - 0.5f, unit(random) - 0.5f)};
        by_hand.push_back(k);
        k.kind = CASE_HARDWARE_TAP, hardware.push_back(k);
    }
    for (const int n : {1, 3, 8})
        for (int i = 0; i < 50; ++i) {
            FilterCase k{.kind = CASE_SEPARABLE,
                .at = 10.0f + 40.0f * vec2(unit(random), unit(random)),
                .z = unit(random),
                .n = n,
                .reconstruct = i % 2};
            by_hand.push_back(k);
            k.kind = CASE_HARDWARE_BOX, hardware.push_back(k);
        }
    const std::vector<float> a = filter(depth, by_hand), b = filter(depth, hardware);
    for (size_t i = 0; i < a.size(); ++i) {
        // filtered compares have weights of 8 bits a side on most hardware; the box has exact ones in both forms
        ASSERT_NEAR(a[i], b[i], by_hand[i].kind == CASE_TAP ? 1.0f / 256 + 1e-6f : 1e-6f) << i;
        if (by_hand[i].kind != CASE_TAP) continue;
        const vec2 at = by_hand[i].at + by_hand[i].d;
        ASSERT_NEAR(double(a[i]), (Twin{depth, by_hand[i]}.tap(double(at.x), double(at.y))), 1e-5);
    }
}

TEST_F(PercentageCloser, AdaptiveIsFullUnlessAllProbesAgree)
{
    const Depths depth = [](int x, int y) { return (x / 5 + y / 7) % 2 ? 0.8f : 0.1f; };
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<FilterCase> full, adaptive;
    for (int i = 0; i < 600; ++i) {
        full.push_back({.at = vec2(unit(random), unit(random)) * float(map_side),
            .z = 0.5f,
            .n = 2 + i % 11,
            .gaussian = i % 2,
            .reconstruct = i % 3});
        adaptive.push_back(full.back());
        adaptive.back().adaptive = 1;
    }
    const std::vector<float> a = filter(depth, full), b = filter(depth, adaptive);
    size_t stopped = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        ASSERT_TRUE(b[i] == 0.0f || b[i] == 1.0f) << i;
        ++stopped;
    }
    EXPECT_LT(stopped, a.size() / 2);
}

TEST_F(PercentageCloser, EmptyMapsAreLitAndWindowsLargerThanTheMapAreFinite)
{
    std::vector<FilterCase> cases;
    for (const vec2 at : {vec2(32, 32), vec2(0, 0), vec2(64, 64), vec2(-300, 1e6f)})
        for (const float z : {0.0f, 0.3f, -1.0f, 5.0f})
            for (const int kind : {CASE_SEPARABLE, CASE_TAP})
                for (const int reconstruct : {0, 1})
                    cases.push_back(
                        {.kind = kind, .at = at, .z = z, .slope = vec2(-9, 3), .n = 127, .reconstruct = reconstruct, .d = vec2(-80, 70)});
    for (const float v : filter([](int, int) { return 0.0f; }, cases)) ASSERT_NEAR(v, 1.0f, 1e-5f);
    for (const float v : filter([](int x, int y) { return (x + y) % 2 ? 1.0f : 0.3f; }, cases))
        ASSERT_TRUE(std::isfinite(v) && v >= 0.0f && v <= 1.0f) << v;
}

/// Stored depth of the plane through p with normal n where the texel `at` looks: the plane's image in the map, by inverting the map.
double plane_in_map(const shaders::LightMapLayer& layer, vec3 p, vec3 n, glm::dvec2 uv)
{
    const glm::dmat4 world_from_map = glm::inverse(glm::dmat4(layer.map_from_world));
    // planes are covectors: pi_map = transpose(world_from_map) pi_world
    const glm::dvec4 plane = glm::transpose(world_from_map) * glm::dvec4(glm::dvec3(n), -glm::dot(glm::dvec3(n), glm::dvec3(p)));
    return -(plane.x * uv.x + plane.y * uv.y + plane.w) / plane.z;
}

TEST_F(PercentageCloser, ReceiverPlaneFollowsTheSurfaceOverTheKernel)
{
    const Bounds bounds{{-4, 0, -3}, {5, 4, 6}};
    const scene::View view = scene::make_view({"", {4, 3, 9}, {0, 1, 0}, {0, 1, 0}, 0.4f}, {320, 200}, bounds);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<shaders::PlaneCase> cases;
    for (const char* text : {"sun,elevation=35,azimuth=200", "spot,position=8/9/7,target=0/0/0,cone=60", "point,position=0.5/2/-0.5"})
        for (int i = 0; i < 900; ++i) {
            const scene::Light light = scene::parse_light(text, {}, bounds);
            const shaders::LightMap map
                = shadow::parts::fit_light_map({}, bounds, view, light, {.fitting = {.fit = int(shadow::parts::Fit::uniform)}});
            const vec3 p = bounds.min + (bounds.max - bounds.min) * vec3(unit(random), unit(random), unit(random));
            const shaders::LightMapLayer& layer = map.layers[tests::select_layer(map, p)];
            if (!tests::project(layer, p).inside) continue;
            // tilted by up to 80 degrees from the layer's axis, towards a random side
            const vec3 axis = glm::normalize(vec3(layer.depth_plane));
            const vec3 side = glm::normalize(glm::cross(axis, glm::normalize(vec3(unit(random), unit(random), unit(random)) - 0.5f)));
            const float tilt = glm::radians(80.0f) * float(i % 9) / 8.0f;
            cases.push_back({layer, map.size, p, -std::cos(tilt) * axis + std::sin(tilt) * side, i % 2 ? 63.5f : 4.5f, 16.0f});
        }
    ASSERT_GT(cases.size(), 1500u);
    const auto results = gpu::run_glsl_cases<shaders::PlaneResult>(device(), "tests/gpu/receiver_plane.comp", cases);
    size_t followed = 0;
    for (size_t i = 0; i < cases.size(); ++i) {
        const shaders::PlaneCase& k = cases[i];
        const tests::MapPoint m = tests::project(k.layer, k.p_world);
        const double range = double(k.layer.far - k.layer.near);
        const double per_metre = k.layer.perspective ? double(k.layer.near * k.layer.far) / (range * m.depth * m.depth) : 1 / range;
        const double texel = per_metre * double(k.layer.texel_metres) * (k.layer.perspective ? m.depth : 1.0);
        // steeper than its tilt where the layer sees it from the side
        const double here = plane_in_map(k.layer, k.p_world, k.n, m.uv);
        const glm::dvec2 step(1.0 / double(k.size), 0.0);
        const double tangent = std::hypot(plane_in_map(k.layer, k.p_world, k.n, m.uv + step) - here,
                                   plane_in_map(k.layer, k.p_world, k.n, m.uv + glm::dvec2(0.0, step.x)) - here)
            / texel;
        if (tangent > 15.0) continue;
        ++followed;
        for (const vec2 way : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(-1, 0), vec2(0, -1), vec2(0.7f, 0.7f)}) {
            const glm::dvec2 d = glm::dvec2(way) * double(k.radius);
            const double got = double(results[i].z) + glm::dot(glm::dvec2(results[i].slope), d);
            const double want = plane_in_map(k.layer, k.p_world, k.n, m.uv + d / double(k.size));
            // never farther from the light than the surface (acne), and nearer by a fiftieth of a texel's slope plus roundings (a shadow's
            // foot)
            ASSERT_GE(got, want) << i << ", tilt " << glm::degrees(std::atan(tangent)) << ", " << (want - got) / texel << " texels";
            const double rounding = std::abs(double(results[i].z)) * 1e-5 + texel * 1.3e-4 * (1 + tangent * tangent) * double(k.radius);
            ASSERT_LE(got, want + texel * tangent / 50 + rounding) << i << ", tilt " << glm::degrees(std::atan(tangent));
        }
    }
}

TEST_F(PercentageCloser, ReceiverPlaneIsHeldWhereTheLightGrazes)
{
    const Bounds bounds{{-4, 0, -3}, {5, 4, 6}};
    const scene::View view = scene::make_view({"", {4, 3, 9}, {0, 1, 0}, {0, 1, 0}, 0.4f}, {320, 200}, bounds);
    const shaders::LightMap map = shadow::parts::fit_light_map({}, bounds, view, scene::parse_light("sun,elevation=90", {}, bounds), {});
    std::vector<shaders::PlaneCase> cases;
    for (const vec3 n : {vec3(1, 0, 0), vec3(0, 0, 1), vec3(0.6f, 0, 0.8f), vec3(1, 1e-6f, 0), vec3(1, -1e-6f, 0), vec3(1, 0.001f, 0)})
        cases.push_back({map.layers[0], map.size, {0, 1, 0}, glm::normalize(n), 4.5f, 16.0f});
    for (const shaders::PlaneResult& r : gpu::run_glsl_cases<shaders::PlaneResult>(device(), "tests/gpu/receiver_plane.comp", cases)) {
        const float texel = map.layers[0].texel_metres / (map.layers[0].far - map.layers[0].near);
        EXPECT_LE(glm::length(r.slope), 16.001f * texel);
        EXPECT_TRUE(std::isfinite(r.z) && r.z < 1.1f) << r.z;
    }
}

} // namespace
} // namespace gnomon
