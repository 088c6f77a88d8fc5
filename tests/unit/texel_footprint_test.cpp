// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/texel_footprint.h"

#include "scene/light.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sampling_error.h"
#include "shadow/parts/warp_parameter.h"
#include "shadow/technique.h"
#include "tests/light_map_twin.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
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

LightMapSettings settings(Fit fit) { return {.size = map_size, .fitting = {.fit = int(fit), .split = 1.0f, .stable = 0, .blend = 0.0f}}; }

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

/// What a fit is to be for an overhead light: parts one behind another, square or as wide and long as they are, and warped with n.
struct Expectation {
    bool cascades = false, square = false, box = false; ///< box: it holds all of it
    double (*near)(const Frustum&) = nullptr; ///< of the warp
};

double optimal(const Frustum& f) { return optimal_near(f.near, f.far, f.depth()); }

/// Fits by name; where one is added this table wants its line.
const std::map<std::string, Expectation> expectations = {
    {"uniform", {.square = true, .box = true}},
    {"focused", {.square = true}},
    {"cascades", {.cascades = true, .square = true}},
    {"lispsm", {.near = optimal}},
    {"cascades_warped", {.cascades = true, .near = optimal}},
    // its default focus is the geometric mean of the depths, and has 0.8 of the map
    {"tsm", {.near = [](const Frustum& f) { return trapezoid_near(std::sqrt(f.near * f.far) - f.near, f.depth(), 0.8); }}},
    // its default looks from a fiftieth of the depth behind the eye
    {"psm", {.near = [](const Frustum& f) { return f.near + 0.02 * f.far; }}},
};

/// The error on the view's axis in a part of the frustum. Square maps: the part's (or box's) longer side both ways.
Error expected_error(const Expectation& e, const Frustum& part, double z)
{
    Error out = overhead_error(part, e.near ? e.near(part) : no_warp, z);
    if (!e.square) return out;
    const double height = 2.0 * std::tan(part.half_fov), width = height * part.far * part.aspect;
    const double extent = e.box ? double(box.max.x - box.min.x) : std::max(width, part.depth());
    return {extent / (height * z), extent / (height * part.aspect * z)};
}

// Maxima of the matrices that maps are drawn with, against the equations: (4.19) to (4.22), for each fit there is.
TEST(TexelFootprint, OverheadMapsHaveTheErrorsOfTheEquations)
{
    const scene::View view = along_z();
    const scene::Light light = scene::parse_light("sun,elevation=90", {}, box);
    const double off_axis = 1.0 / std::cos(frustum.half_fov);
    const std::vector<std::string> fits = technique("shadow_map").params().find("fit")->choices;
    for (size_t fit = 0; fit < fits.size(); ++fit) {
        if (fits[fit] == "sdsm") continue; // placed on the device, from what is drawn
        SCOPED_TRACE(fits[fit]);
        ASSERT_TRUE(expectations.count(fits[fit])) << "this table wants a line for each fit";
        const Expectation& expectation = expectations.at(fits[fit]);
        const shaders::LightMap map = fit_light_map({}, box, view, light, settings(Fit(fit)));
        ASSERT_EQ(map.layer_count, expectation.cascades ? 4u : 1u);
        for (uint32_t i = 0; i < map.layer_count; ++i) {
            Frustum part = frustum;
            part.near = std::pow(frustum.ratio(), double(i) / map.layer_count);
            part.far = std::pow(frustum.ratio(), (i + 1.0) / map.layer_count);
            const double rim = double(rim_factor(settings(Fit(fit))));
            Error largest{0, 0};
            for (int k = 0; k <= 200; ++k) {
                const double z = part.near * std::pow(part.ratio(), 1e-6 + k * (1.0 - 2e-6) / 200.0);
                const Error e = expected_error(expectation, part, z), on_axis = measured(map.layers[i], view, z, 0.0);
                largest = {std::max(largest.t, e.t * rim * off_axis), std::max(largest.s, e.s * rim)};
                EXPECT_NEAR(on_axis.t / (e.t * rim), 1.0, 0.01) << "layer " << i << ", depth " << z;
                EXPECT_NEAR(on_axis.s / (e.s * rim), 1.0, 0.01) << "layer " << i << ", depth " << z;
            }
            const Error all = largest_measured(map, view, part.near * 1.0001, part.far * 0.9999);
            EXPECT_NEAR(all.t / largest.t, 1.0, 0.02) << "layer " << i;
            EXPECT_NEAR(all.s / largest.s, 1.0, 0.02) << "layer " << i;
        }
    }
}

// Largest errors where the light tilts towards the view, of a map warped as the falloff says.
TEST(TexelFootprint, TiltedWarpsHaveTheErrorsOfTheEquations)
{
    const std::vector<std::string> fits = technique("shadow_map").params().find("fit")->choices;
    const auto fit = Fit(std::find(fits.begin(), fits.end(), "lispsm") - fits.begin());
    const scene::View view = along_z();
    for (const int elevation : {40, 60, 80})
        for (const int azimuth : {0, 180}) {
            const std::string text = fmt::format("sun,elevation={},azimuth={}", elevation, azimuth);
            SCOPED_TRACE(text);
            const scene::Light light = scene::parse_light(text, {}, box);
            const vec3 direction = std::get<scene::DirectionalLight>(light.shape).direction;
            ASSERT_NEAR(direction.x, 0.0f, 1e-6f);
            const double gamma = std::acos(std::abs(double(direction.z))); // either way round
            const shaders::LightMap map = fit_light_map({}, box, view, light, settings(fit));
            const Error expected = tilted_largest(frustum, gamma, tilted_shaped_near(frustum, gamma));
            const Error all = largest_measured(map, view, frustum.near * 1.0001, frustum.far * 0.9999);
            const double rim = double(rim_factor(settings(fit)));
            EXPECT_NEAR(all.t / (expected.t * rim), 1.0, 0.02);
            EXPECT_NEAR(all.s / (expected.s * rim), 1.0, 0.02);
        }
}

// (3.9) with the light's own perspective, d_l / n_l and cos phi_t.
TEST(TexelFootprint, SpotsHaveTheErrorsOfTheEquations)
{
    const scene::View view = along_z();
    const scene::Light light = scene::parse_light("spot,position=0/80/50,target=0/0/50,cone=80", {}, box);
    const shaders::LightMapLayer layer = fit_light_map({}, box, view, light, settings(Fit::focused)).layers[0];
    const double at_one_metre = double(layer.texel_metres) * map_size;
    for (const double z : {20.0, 40.0, 50.0, 70.0})
        for (const double up : {-0.5, 0.0, 0.4}) {
            const double y = up * z * std::tan(frustum.half_fov), depth = 80.0 - y;
            const double cos_light = depth / std::hypot(depth, z - 50.0), cos_eye = z / std::hypot(z, y);
            const double height = 2.0 * std::tan(frustum.half_fov) * z;
            const Error e = measured(layer, view, z, up);
            EXPECT_NEAR(e.t / (at_one_metre * depth * cos_light / (cos_eye * height)), 1.0, 1e-3) << z << " " << up;
            EXPECT_NEAR(e.s / (at_one_metre * depth / (height * frustum.aspect)), 1.0, 1e-3) << z << " " << up;
        }
}

} // namespace
} // namespace gnomon::shadow::parts
