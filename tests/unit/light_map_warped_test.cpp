// SPDX-License-Identifier: Apache-2.0
// Warped light maps as homographies: what they hold, how tightly, and which way round.
#include "scene/view.h"
#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace gnomon::shadow::parts {
namespace {

using tests::project;
using tests::select_layer;

constexpr base::Size picture{320, 180};
constexpr Fit warps[] = {Fit::psm, Fit::lispsm, Fit::tsm, Fit::cascades_warped};

class Random {
public:
    explicit Random(unsigned seed)
        : engine_(seed)
    {
    }
    float operator()(float from = -1.0f, float to = 1.0f) { return std::uniform_real_distribution<float>(from, to)(engine_); }
    vec3 in(const Bounds& b) { return b.min + (b.max - b.min) * vec3((*this)(0, 1), (*this)(0, 1), (*this)(0, 1)); }
    vec3 direction()
    {
        for (;;) {
            const vec3 v((*this)(), (*this)(), (*this)());
            const float length = glm::length(v);
            if (length > 0.1f && length < 1.0f) return v / length;
        }
    }
    int below(int n) { return std::min(int((*this)(0, float(n))), n - 1); }

private:
    std::mt19937 engine_;
};

scene::Light sun(vec3 direction)
{
    scene::Light light;
    light.shape = scene::DirectionalLight{glm::normalize(direction), 0.0f};
    return light;
}

scene::Light spot(vec3 position, vec3 direction, float half_angle)
{
    scene::Light light;
    scene::SpotLight shape;
    shape.position = position, shape.direction = glm::normalize(direction);
    shape.outer_angle = shape.inner_angle = half_angle;
    light.shape = shape;
    return light;
}

struct Case {
    Bounds bounds;
    scene::View view;
    scene::Light light;
};

Case random_case(Random& random)
{
    Case c;
    const float size = std::pow(10.0f, random(-1, 3.5f));
    const vec3 low = size * vec3(random(), random(), random());
    c.bounds = {low, low + size * vec3(random(0.1f, 1), random(0.0f, 1), random(0.1f, 1))};
    const vec3 middle = c.bounds.centre();
    const vec3 eye = random.below(2) ? random.in(c.bounds) : middle + 3.0f * c.bounds.radius() * random.direction();
    scene::Camera camera{"", eye, random.below(4) ? middle : eye + random.direction(), {0, 1, 0}, random(0.05f, 2.5f)};
    if (glm::length(camera.target - eye) < 1e-3f * size) camera.target = eye + vec3(size, 0, 0);
    c.view = scene::make_view(camera, picture, c.bounds);
    if (random.below(3)) {
        const vec3 forward = forward_of(c.view);
        const vec3 special[]
            = {forward, -forward, glm::cross(forward, random.direction()), vec3(0, -1, 0), forward + 1e-4f * random.direction()};
        c.light = sun(random.below(3) ? random.direction() : special[random.below(5)]);
    } else {
        const vec3 position = random.below(2) ? random.in(c.bounds) : middle + 2.0f * c.bounds.radius() * random.direction();
        c.light
            = spot(position, random.below(2) ? middle - position + 1e-3f * random.direction() : random.direction(), random(0.01f, 1.56f));
    }
    return c;
}

shaders::LightMap fitted(const Case& c, Fit fit, int size = 512)
{
    return fit_light_map({}, c.bounds, c.view, c.light, {.size = size, .fitting = {.fit = int(fit), .stable = 0}});
}

bool is_seen(const scene::View& view, vec3 p)
{
    const vec4 clip = view.clip_from_world * vec4(p, 1);
    return clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z > 0 && clip.z < clip.w;
}

/// Points of the scene that the view sees and the light may reach.
std::vector<vec3> receivers(const Case& c, Random& random, int tries)
{
    std::vector<vec3> out;
    const std::vector<vec3> part = visible_part(c.view, c.bounds);
    if (part.empty()) return out;
    Bounds around;
    for (const vec3 p : part) around.add(p);
    for (int i = 0; i < tries; ++i) {
        const vec3 p = i % 2 ? random.in(around) : glm::mix(part[size_t(random.below(int(part.size())))], random.in(around), 0.01f);
        const bool in_box = glm::all(glm::greaterThanEqual(p, c.bounds.min)) && glm::all(glm::lessThanEqual(p, c.bounds.max));
        if (in_box && is_seen(c.view, p) && scene::reaches(c.light, p)) out.push_back(p);
    }
    return out;
}

vec3 ray_at(const Case& c, vec3 p)
{
    if (const auto* s = std::get_if<scene::DirectionalLight>(&c.light.shape)) return s->direction;
    return glm::normalize(p - std::get<scene::SpotLight>(c.light.shape).position);
}

double winding(const shaders::LightMapLayer& layer, vec3 p, float step)
{
    const vec3 axis(layer.depth_plane);
    const vec3 x = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0))), y = glm::cross(axis, x);
    const glm::dvec2 a = project(layer, p + step * x).uv - project(layer, p - step * x).uv,
                     b = project(layer, p + step * y).uv - project(layer, p - step * y).uv;
    return a.x * b.y - a.y * b.x;
}

void expect_sound(const shaders::LightMap& map)
{
    for (uint32_t i = 0; i < map.layer_count; ++i) {
        const shaders::LightMapLayer& layer = map.layers[i];
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) ASSERT_TRUE(std::isfinite(layer.map_from_world[c][r]));
        ASSERT_TRUE(std::isfinite(layer.near) && std::isfinite(layer.far) && layer.near < layer.far);
        ASSERT_TRUE(std::isfinite(layer.texel_metres) && layer.texel_metres > 0.0f);
        ASSERT_EQ(layer.warped, map.layers[0].warped) << "layers of one map are drawn by one program";
    }
}

TEST(WarpedFit, AnySceneViewAndLightHasAMapThatHoldsWhatIsSeen)
{
    Random random(21);
    int warped = 0, gave_way = 0;
    for (int i = 0; i < 3000; ++i) {
        const Case c = random_case(random);
        const std::vector<vec3> seen = receivers(c, random, 40);
        for (const Fit fit : warps) {
            SCOPED_TRACE(testing::Message() << "case " << i << ", fit " << int(fit));
            const shaders::LightMap map = fitted(c, fit);
            ASSERT_NO_FATAL_FAILURE(expect_sound(map));
            const bool one_layer = map.layout_kind != LIGHT_MAP_CUBE;
            if (one_layer) (map.layers[0].warped ? warped : gave_way)++;
            if (one_layer && map.layers[0].warped == 0) {
                ASSERT_NE(map.fit_used, int(fit));
            }
            for (const vec3 p : seen) {
                const tests::MapPoint m = project(map.layers[select_layer(map, p)], p);
                // positions far from the origin round to a few millionths of the scene
                ASSERT_TRUE(m.w > 0.0 && std::min(m.uv.x, m.uv.y) >= 0.5 / 512 && std::max(m.uv.x, m.uv.y) <= 1 - 0.5 / 512)
                    << m.uv.x << " " << m.uv.y << " " << m.w;
                ASSERT_TRUE(m.z >= -1e-5 && m.z <= 1.0 + 1e-5) << m.z;
            }
        }
    }
    EXPECT_GT(warped, 3000);
    EXPECT_GT(gave_way, 1000);
}

TEST(WarpedFit, ALightsRayIsAPointOfTheMapAlsoBehindTheEye)
{
    Random random(22);
    int checked = 0;
    for (int i = 0; i < 400; ++i) {
        const Case c = random_case(random);
        const double size = double(c.bounds.radius());
        for (const Fit fit : warps) {
            const shaders::LightMap map = fitted(c, fit);
            if (map.layers[0].warped == 0 || map.layout_kind == LIGHT_MAP_CUBE) continue;
            for (const vec3 p : receivers(c, random, 6)) {
                const shaders::LightMapLayer& layer = map.layers[select_layer(map, p)];
                const vec3 ray = ray_at(c, p);
                const tests::MapPoint at = project(layer, p);
                double before = at.depth;
                for (const double part : {0.1, 0.4, 0.9}) { // casters nearer the light, wherever the eye is
                    const double back = part * (layer.perspective ? at.depth * 0.9 : size);
                    const vec3 caster = p - float(back) * ray;
                    const tests::MapPoint m = project(layer, caster);
                    // by how much a position in float may be off, in the map
                    const double rounding = 4e-7 * (double(glm::length(p)) + 2.0 * size) / std::min(at.texel.x, at.texel.y)
                        * (layer.perspective ? at.depth / m.depth : 1.0);
                    ASSERT_NEAR(m.uv.x, at.uv.x, (rounding + 0.05) / 512) << "case " << i << ", fit " << int(fit);
                    ASSERT_NEAR(m.uv.y, at.uv.y, (rounding + 0.05) / 512) << "case " << i << ", fit " << int(fit);
                    ASSERT_GT(m.w, 0.0);
                    ASSERT_LT(m.depth, before);
                    before = m.depth, ++checked;
                }
            }
        }
    }
    EXPECT_GT(checked, 1000);
}

TEST(WarpedFit, TheRectangleIsTightAndKeepsItsWinding)
{
    Random random(23);
    int tight = 0;
    for (int i = 0; i < 600; ++i) {
        const Case c = random_case(random);
        if (c.light.kind() != scene::LightKind::directional) continue;
        const std::vector<vec3> part = visible_part(c.view, c.bounds);
        if (part.empty()) continue;
        const double winds = winding(fitted(c, Fit::uniform).layers[0], part.front(), 0.01f * c.bounds.radius());
        for (const Fit fit : {Fit::psm, Fit::lispsm, Fit::tsm}) {
            const shaders::LightMap map = fitted(c, fit);
            if (map.layers[0].warped == 0) continue;
            glm::dvec2 least(2.0), most(-1.0);
            for (const vec3 p : part) {
                const glm::dvec2 uv = project(map.layers[0], p).uv;
                least = glm::min(least, uv), most = glm::max(most, uv);
            }
            for (int k = 0; k < 2; ++k) { // the rim of two texels, and what positions round to where texels are least
                EXPECT_NEAR(least[k], 2.0 / 512, 1.0 / 512) << "case " << i << ", fit " << int(fit);
                EXPECT_NEAR(most[k], 1.0 - 2.0 / 512, 1.0 / 512) << "case " << i << ", fit " << int(fit);
            }
            const vec3 middle = std::accumulate(part.begin(), part.end(), vec3(0)) / float(part.size());
            EXPECT_GT(winding(map.layers[0], middle, 1e-3f * c.bounds.radius()) * winds, 0.0) << "case " << i << ", fit " << int(fit);
            ++tight;
        }
    }
    EXPECT_GT(tight, 300);
}

/// A view frustum of 60 degrees along -z from `near` to `far` that is all that is seen of the scene.
Case frustum_case(float near, float far, vec3 light)
{
    Case c;
    c.bounds = {{-2 * far, -2 * far, -far}, {2 * far, 2 * far, far}};
    c.view = scene::make_view({"", vec3(0), {0, 0, -1}, {0, 1, 0}, pi / 3.0f, 0.0f, near}, {256, 256}, c.bounds);
    c.light = sun(light);
    return c;
}

/// Texels' widths over pixels' widths in u and v, the largest of what is seen (Eisemann et al. 2011, 4.2.2: perspective errors with one
/// pixel a texel of the map), on the frustum's faces, where they are largest (Lloyd 2007).
glm::dvec2 largest_error(const Case& c, const shaders::LightMapLayer& layer, float far, int size)
{
    const double near = double(c.view.near), tangent = std::tan(double(pi) / 6.0);
    glm::dvec2 most(0.0);
    for (int step = 0; step <= 200; ++step) {
        const double depth = near * std::pow(double(far) / near, step / 200.0);
        for (int x = -4; x <= 4; ++x)
            for (int y = -4; y <= 4; ++y) {
                const vec3 p(float(x / 4.0 * tangent * depth), float(y / 4.0 * tangent * depth), float(-depth));
                // texels of a map of as many as the picture has pixels, without a rim
                most = glm::max(most, project(layer, p).texel * double(size) / (2.0 * tangent * depth));
            }
    }
    return most;
}

// Equations 4.21 to 4.25 and the storage factor of no warp, for a light straight from above.
TEST(WarpedFit, OverheadErrorsAreTheClosedForms)
{
    constexpr int size = 4096;
    const double rim = double(rim_factor({.size = size})), tangent = std::tan(double(pi) / 6.0);
    for (const float ratio : {10.0f, 100.0f, 1000.0f}) {
        const Case c = frustum_case(1.0f, ratio, {0, -1, 0});
        const glm::dvec2 e = largest_error(c, fitted(c, Fit::lispsm, size).layers[0], ratio, size) / rim;
        const double r = double(ratio), warped = (r - 1.0) / (2.0 * tangent), across = std::sqrt(r);
        EXPECT_NEAR(e.x, across, 0.02 * across) << ratio;
        EXPECT_NEAR(e.y, warped / across, 0.02 * warped / across) << ratio;
        EXPECT_NEAR(e.x * e.y, warped, 0.02 * warped) << ratio;
    }
}

vec3 tilted(float degrees, float roll)
{
    const float gamma = degrees * pi / 180.0f;
    return {std::sin(gamma) * std::sin(roll), -std::sin(gamma) * std::cos(roll), -std::cos(gamma)};
}

// The sine alone is up to 2.5 times worse than no warp where the light is closer to the view's axis than half a field of view.
TEST(WarpedFit, NoTiltMakesLloydsWarpWorseThanNone)
{
    constexpr int size = 1024;
    int warped = 0;
    for (const float roll : {0.0f, 0.7f, pi / 2.0f})
        for (int degrees = 0; degrees <= 180; degrees += 5) {
            SCOPED_TRACE(testing::Message() << degrees << " degrees, roll " << roll);
            const Case c = frustum_case(1.0f, 100.0f, tilted(float(degrees), roll));
            const shaders::LightMapLayer focused = fitted(c, Fit::focused, size).layers[0];
            const shaders::LightMapLayer layer = fitted(c, Fit::lispsm, size).layers[0];
            const glm::dvec2 plain = largest_error(c, focused, 100.0f, size), e = largest_error(c, layer, 100.0f, size);
            warped += int(layer.warped);
            EXPECT_LE(e.x * e.y, 1.001 * plain.x * plain.y);
            EXPECT_LE(std::max(e.x, e.y), 1.12 * std::max(plain.x, plain.y)) << "what falls short in one axis is won in the other";
        }
    EXPECT_GT(warped, 60) << "of 111";
}

// A strong falloff leaves an affine map: the middle between two points of the scene is the middle of the map.
TEST(WarpedFit, TheWeakestWarpIsNone)
{
    constexpr int size = 1024;
    float weakest = 0.0f; // degrees
    for (float degrees = 15.0f; degrees > 5.0f; degrees -= 0.0005f) {
        if (fitted(frustum_case(1.0f, 100.0f, tilted(degrees, 0.0f)), Fit::lispsm, size).layers[0].warped == 0) break;
        weakest = degrees;
    }
    ASSERT_LT(weakest, 10.1f) << "a third of half the field of view";
    const Case c = frustum_case(1.0f, 100.0f, tilted(weakest, 0.0f));
    const shaders::LightMapLayer layer = fitted(c, Fit::lispsm, size).layers[0];
    Random random(24);
    const std::vector<vec3> seen = receivers(c, random, 1000);
    ASSERT_GT(seen.size(), 100u);
    for (size_t i = 1; i < seen.size(); ++i) {
        const glm::dvec2 ends = project(layer, seen[i]).uv + project(layer, seen[i - 1]).uv;
        const glm::dvec2 apart = project(layer, 0.5f * (seen[i] + seen[i - 1])).uv - 0.5 * ends;
        ASSERT_LT(glm::length(apart) * double(size), 1.0);
    }
}

} // namespace
} // namespace gnomon::shadow::parts
