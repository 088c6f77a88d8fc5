// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/texel_footprint.h"

#include "scene/light.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sampling_error.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace gnomon::shadow::parts {
namespace {

using glm::dmat2;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// The view's axis is +z from the origin, its near plane at 1. The box ends at 100 and holds the frustum up to there.
const Bounds box{{-400, -400, -20}, {400, 400, 100}};
constexpr base::Size picture{640, 360};
constexpr int map_size = 512;
const Frustum frustum{1.0, 100.0, glm::radians(30.0), 640.0 / 360.0};

scene::View along_z()
{
    return scene::make_view(
        {.eye = {0, 0, 0}, .target = {0, 0, 1}, .fov_y = float(2.0 * frustum.half_fov), .near = float(frustum.near)}, picture, box);
}

LightMapSettings settings(Fit fit) { return {.size = map_size, .fitting = {.fit = int(fit), .split = 1.0f, .stable = 0}}; }

/// (3.4) without its off-diagonals: the texel's edge along the picture's height, by that of a map with as many texels as the picture has
/// pixels, and the other along its width.
Error components(const dmat2& m)
{
    const bool t_first = std::abs(m[0].y) > std::abs(m[1].y);
    const dvec2 t = t_first ? m[0] : m[1], s = t_first ? m[1] : m[0];
    return {std::abs(t.y) * map_size / picture.height, std::abs(s.x) * map_size / picture.width};
}

/// The perspective error at depth z, at `up` of half the picture's height off the axis.
Error measured(const shaders::LightMapLayer& layer, const scene::View& view, double z, double up)
{
    const dvec3 p(0.0, up * z * std::tan(frustum.half_fov), z);
    return components(texel_footprint(layer, map_size, view, p, {0, 1, 0}).perspective);
}

/// The largest errors in the plane x = 0 of the frustum, in the layer that each depth has.
Error largest_measured(const shaders::LightMap& map, const scene::View& view, double from, double to)
{
    Error out{0, 0};
    for (int i = 0; i <= 400; ++i) {
        const double z = from * std::pow(to / from, i / 400.0);
        for (const double up : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            const int index = tests::select_layer(map, vec3(0, 0, float(z)));
            const Error e = measured(map.layers[index], view, z, up);
            out = {std::max(out.t, e.t), std::max(out.s, e.s)};
        }
    }
    return out;
}

// A surface's own derivatives by differences: pixels and texels of points beside p.
TEST(TexelFootprint, IsTheDerivativeOnTheSurface)
{
    const Bounds bounds{{-4, 0, -3}, {5, 4, 6}};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const char* text : {"sun,elevation=35,azimuth=200", "spot,position=8/9/7,target=0/0/0,cone=30", "point,position=0.5/7/-0.5"})
        for (const float half_height : {0.0f, 4.0f}) {
            const scene::View view
                = scene::make_view({.eye = {4, 3, 19}, .target = {0, 1, 0}, .half_height = half_height}, {320, 200}, bounds);
            const shaders::LightMap map = fit_light_map(
                {}, bounds, view, scene::parse_light(text, {}, bounds), {.size = 256, .fitting = {.fit = int(Fit::focused)}});
            for (int i = 0; i < 100; ++i) {
                const dvec3 p = dvec3(bounds.min) + dvec3(bounds.max - bounds.min) * dvec3(unit(random), unit(random), unit(random));
                const dvec3 n = glm::normalize(dvec3(unit(random), unit(random), unit(random)) - 0.5);
                const shaders::LightMapLayer& layer = map.layers[tests::select_layer(map, vec3(p))];
                const TexelFootprint f = texel_footprint(layer, 256, view, p, n);
                const dvec3 a = glm::normalize(glm::cross(n, dvec3(0.3, 0.5, 0.8))), b = glm::cross(n, a);
                const auto differences = [&](const glm::dmat4& m, dvec2 scale, dvec3 d) {
                    const dvec4 h = m * dvec4(p + 1e-5 * d, 1), g = m * dvec4(p - 1e-5 * d, 1);
                    return (dvec2(h.x, h.y) / h.w - dvec2(g.x, g.y) / g.w) * scale / 2e-5;
                };
                const glm::dmat4 to_texel(layer.map_from_world), to_pixel(view.clip_from_world);
                const dmat2 texel(differences(to_texel, dvec2(256), a), differences(to_texel, dvec2(256), b));
                const dmat2 pixel(differences(to_pixel, {160, 100}, a), differences(to_pixel, {160, 100}, b));
                const dmat2 expected = pixel * glm::inverse(texel);
                if (longer_edge(expected) > 1e4) continue; // edge-on to the light
                for (int c = 0; c < 2; ++c)
                    EXPECT_LT(glm::length(f.total[c] - expected[c]), 1e-4 * longer_edge(expected)) << text << " " << i;
                // the split: areas differ by the quotient of the cosines, and the perspective part knows no surface
                EXPECT_NEAR(std::abs(glm::determinant(f.total)) / (std::abs(glm::determinant(f.perspective)) * f.projection), 1.0, 1e-6);
                const TexelFootprint other = texel_footprint(layer, 256, view, p, glm::normalize(n + dvec3(0, 2, 0)));
                for (int c = 0; c < 2; ++c)
                    EXPECT_LT(glm::length(f.perspective[c] - other.perspective[c]), 1e-9 * longer_edge(f.perspective));
            }
        }
}

// The surface that both beams meet at one angle has the perspective error alone.
TEST(TexelFootprint, PerspectiveIsTheErrorOfTheSurfaceHalfway)
{
    const scene::View view = along_z();
    for (const char* text :
        {"sun,elevation=30,azimuth=120", "sun,elevation=80,azimuth=10", "spot,position=10/90/-20,target=0/0/40,cone=50"}) {
        const scene::Light light = scene::parse_light(text, {}, box);
        const shaders::LightMapLayer layer = fit_light_map({}, box, view, light, settings(Fit::focused)).layers[0];
        for (const dvec3 p : {dvec3(0, 0, 5), dvec3(2, -3, 10), dvec3(-20, 10, 60)}) {
            const vec4 source = scene::light_point(light, vec3(p), vec2(0.5f));
            const dvec3 l = glm::normalize(dvec3(vec3(source)) - double(source.w) * p);
            const TexelFootprint f = texel_footprint(layer, map_size, view, p, glm::normalize(l + glm::normalize(-p)));
            EXPECT_NEAR(f.projection, 1.0, 1e-4);
            for (int c = 0; c < 2; ++c) EXPECT_LT(glm::length(f.total[c] - f.perspective[c]), 2e-4 * longer_edge(f.total)) << text;
        }
    }
}

/// An overhead light's fits and what the equations say of them. A fit that is not listed fails the test.
struct Expectation {
    std::function<Error(const shaders::LightMap&, double z)> at; ///< on the view's axis
};

/// A square map without a warp: `extent` metres a side.
Error uniform_error(double extent, double z)
{
    const double height = 2.0 * std::tan(frustum.half_fov) * z;
    return {extent / height, extent / (height * frustum.aspect)};
}

double extent_of(const shaders::LightMapLayer& layer) { return double(layer.texel_metres) * map_size; }

TEST(TexelFootprint, OverheadMapsHaveTheErrorsOfTheEquations)
{
    const scene::View view = along_z();
    const scene::Light light = scene::parse_light("sun,elevation=90", {}, box);
    const double above = 1.0 / std::cos(frustum.half_fov), width = 2.0 * std::tan(frustum.half_fov) * frustum.far * frustum.aspect;
    for (const Fit fit : {Fit::uniform, Fit::focused, Fit::cascades}) {
        SCOPED_TRACE(int(fit));
        const shaders::LightMap map = fit_light_map({}, box, view, light, settings(fit));
        // what the fit is to cover: the box, the frustum, or its parts at logarithmic splits
        for (uint32_t i = 0; i < map.layer_count; ++i) {
            const double part = 1.0 / map.layer_count, from = std::pow(frustum.ratio(), part * i),
                         to = std::pow(frustum.ratio(), part * (i + 1));
            const double extent = fit == Fit::uniform ? 800.0 : std::max(width * to / frustum.far, to - from);
            EXPECT_NEAR(extent_of(map.layers[i]) / (extent * rim_factor(settings(fit))), 1.0, 2e-3);
            // a square map as wide as it must be: (4.19) and (4.22) for n to infinity, by the map's shape
            const Error end = largest_measured(map, view, from * 1.0001, to), expected = uniform_error(extent, from);
            EXPECT_NEAR(end.t / (expected.t * above), 1.0, 0.02);
            EXPECT_NEAR(end.s / expected.s, 1.0, 0.02);
        }
        for (const double z : {1.1, 4.0, 20.0, 90.0}) {
            const shaders::LightMapLayer& layer = map.layers[tests::select_layer(map, vec3(0, 0, float(z)))];
            const Error e = measured(layer, view, z, 0.0), expected = uniform_error(extent_of(layer), z);
            EXPECT_NEAR(e.t / expected.t, 1.0, 1e-3) << z;
            EXPECT_NEAR(e.s / expected.s, 1.0, 1e-3) << z;
        }
    }
}

} // namespace
} // namespace gnomon::shadow::parts
