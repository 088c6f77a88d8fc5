// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/clip.h"
#include "shadow/parts/light_map.h"
#include "tests/light_map_twin.h"

#include "scene/load.h"
#include "shadow/scene_gpu.h"
#include "truth/truth.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace gnomon::shadow::parts {
namespace {

using tests::project;
using tests::select_layer;

constexpr base::Size picture{96, 64};
const char* const suns[] = {"sun,elevation=50,azimuth=35", "sun,elevation=90", "sun,elevation=2,azimuth=0", "sun,elevation=30,azimuth=180"};

scene::Scene builtin(std::string_view name)
{
    for (const scene::Builtin& b : scene::builtins())
        if (b.name == name) return b.make(0.1);
    throw std::logic_error("no built-in scene " + std::string(name));
}

std::vector<vec3> visible_points(const scene::Scene& scene, const scene::View& view)
{
    const truth::Primary primary = truth::Tracer(scene).primary(view);
    std::vector<vec3> out;
    for (size_t i = 0; i < primary.primitive.size(); ++i)
        if (primary.primitive[i] != truth::no_primitive)
            out.emplace_back(primary.position.values[3 * i], primary.position.values[3 * i + 1], primary.position.values[3 * i + 2]);
    return out;
}

std::vector<vec3> all_vertices(const scene::Scene& scene)
{
    std::vector<vec3> out;
    for (const scene::Instance& i : scene.instances)
        for (const vec3 p : scene.meshes[size_t(i.mesh)].positions) out.emplace_back(i.world_from_object * vec4(p, 1));
    return out;
}

bool finite(const shaders::LightMapLayer& layer)
{
    bool ok = std::isfinite(layer.near) && std::isfinite(layer.far) && layer.near < layer.far && std::isfinite(layer.texel_metres)
        && layer.texel_metres > 0.0f;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) ok = ok && std::isfinite(layer.map_from_world[c][r]);
    return ok;
}

/// Points that may be shadowed: with a neighbour on each side in their layer, and a depth that the format holds.
void expect_held(const shaders::LightMap& map, const std::vector<vec3>& points, const std::string& what)
{
    size_t outside = 0, before = 0, beyond = 0;
    const double rim = 1.0 / double(map.size);
    for (const vec3 p : points) {
        const tests::MapPoint m = project(map.layers[select_layer(map, p)], p);
        outside += !(m.w > 0.0 && std::min(m.uv.x, m.uv.y) >= rim && std::max(m.uv.x, m.uv.y) <= 1.0 - rim);
        before += !(m.z <= 1.0), beyond += !(m.z >= 0.0);
    }
    EXPECT_EQ(outside, 0u) << what << ", of " << points.size();
    EXPECT_EQ(before, 0u) << what << ", of " << points.size();
    EXPECT_EQ(beyond, 0u) << what << ", of " << points.size();
}

/// The two ways to a stored depth, by the matrix and by the linear depth, are one.
void expect_consistent(const shaders::LightMap& map, const std::vector<vec3>& points)
{
    for (uint32_t i = 0; i < map.layer_count; ++i) {
        const shaders::LightMapLayer& layer = map.layers[i];
        ASSERT_TRUE(finite(layer));
        EXPECT_NEAR(tests::stored_from_depth(layer, double(layer.near)), 1.0, 1e-6);
        EXPECT_NEAR(tests::stored_from_depth(layer, double(layer.far)), 0.0, 1e-6);
        EXPECT_NEAR(tests::depth_from_stored(layer, tests::stored_from_depth(layer, 0.5 * double(layer.near + layer.far))),
            0.5 * double(layer.near + layer.far), 1e-6 * double(std::abs(layer.near) + std::abs(layer.far)));
    }
    for (const vec3 p : points) {
        const shaders::LightMapLayer& layer = map.layers[select_layer(map, p)];
        const tests::MapPoint m = project(layer, p);
        ASSERT_NEAR(m.z, tests::stored_from_depth(layer, m.depth), 1e-5);
        if (layer.perspective)
            ASSERT_EQ(m.w, m.depth);
        else
            ASSERT_EQ(m.w, 1.0);
    }
}

std::vector<scene::Camera> cameras(const scene::Scene& scene)
{
    std::vector<scene::Camera> out = scene.cameras;
    out.push_back(scene::fit_camera(scene.bounds()));
    return out;
}

class LightMapFitScene : public testing::TestWithParam<const char*> { };

TEST_P(LightMapFitScene, VisibleReceiversAndAllCastersLieInASunsMap)
{
    const scene::Scene scene = builtin(GetParam());
    const Bounds bounds = scene.bounds();
    const std::vector<vec3> vertices = all_vertices(scene);
    for (const scene::Camera& camera : cameras(scene)) {
        const scene::View view = scene::make_view(camera, picture, bounds);
        const std::vector<vec3> seen = visible_points(scene, view);
        ASSERT_GT(seen.size(), 500u);
        for (const char* sun : suns) {
            const std::string what = std::string(GetParam()) + " " + camera.name + " " + sun;
            const scene::Light light = scene::parse_light(sun, {}, bounds);
            const shaders::LightMap of_view
                = fit_light_map(scene, bounds, view, light, {.size = 512, .fitting = {.fit = int(Fit::focused)}});
            const shaders::LightMap of_scene
                = fit_light_map(scene, bounds, view, light, {.size = 512, .fitting = {.fit = int(Fit::uniform)}});
            expect_held(of_view, seen, what + ", fit=view");
            expect_held(of_scene, vertices, what + ", fit=scene");
            expect_consistent(of_view, seen);
            expect_consistent(of_scene, vertices);
            for (const int stable : {0, 1}) {
                const shaders::LightMap cascades
                    = fit_light_map(scene, bounds, view, light, {.size = 512, .fitting = {.fit = int(Fit::cascades), .stable = stable}});
                expect_held(cascades, seen, what + ", fit=cascades");
                expect_consistent(cascades, seen);
            }
            EXPECT_LE(of_view.layers[0].texel_metres, of_scene.layers[0].texel_metres * 1.0001f) << what;
            size_t before = 0; // of what may cast into the part of the map that the view uses
            for (const vec3 p : vertices) before += project(of_view.layers[0], p).z > 1.0;
            EXPECT_EQ(before, 0u) << what;
        }
    }
}

TEST_P(LightMapFitScene, LightsWithAPositionHoldTheScene)
{
    const scene::Scene scene = builtin(GetParam());
    const Bounds bounds = scene.bounds();
    const scene::View view = scene::make_view(scene::fit_camera(bounds), picture, bounds);
    const vec3 inside = bounds.centre() + vec3(0.01f, 0.37f, 0.02f) * bounds.radius(),
               outside = bounds.centre() + vec3(1, 2, 1.5f) * bounds.radius();
    for (const vec3 position : {inside, outside}) {
        scene::Light light;
        light.shape = scene::PointLight{position, 0.0f};
        const shaders::LightMap cube = fit_light_map(scene, bounds, view, light, {.size = 512});
        ASSERT_EQ(cube.layer_count, 6u);
        std::vector<vec3> held; // nearer than this a light inside the scene is blind
        for (const vec3 p : all_vertices(scene))
            if (glm::length(p - position) > 2.0f * cube.layers[0].near) held.push_back(p);
        expect_held(cube, held, "cube");
        expect_consistent(cube, held);

        const scene::SpotLight spot{position, glm::normalize(bounds.centre() - position), 0.0f, glm::radians(59.9f), 0.0f};
        light.shape = spot;
        const shaders::LightMap cone = fit_light_map(scene, bounds, view, light, {.size = 512});
        ASSERT_EQ(cone.layer_count, 1u);
        std::erase_if(held, [&](vec3 p) { return !reaches(light, p); });
        expect_held(cone, held, "spot");
        expect_consistent(cone, held);
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, LightMapFitScene,
    testing::Values("balls", "contact", "citadel", "colonnade", "terrain", "tilted_planes", "duelling_frusta", "closed_box"),
    [](const testing::TestParamInfo<const char*>& p) { return std::string(p.param); });

scene::Scene balls() { return builtin("balls"); }

TEST(LightMapFit, WideSpotsAndAreaLightsTakeACube)
{
    const scene::Scene scene = balls();
    const scene::View view = scene::make_view(scene::fit_camera(scene.bounds()), picture, scene.bounds());
    const auto layers = [&](scene::LightShape shape) {
        scene::Light light;
        light.shape = shape;
        return fit_light_map(scene, scene.bounds(), view, light, {}).layer_count;
    };
    EXPECT_EQ(layers(scene::DirectionalLight{}), 1u);
    EXPECT_EQ(layers(scene::SpotLight{{0, 3, 0}, {0, -1, 0}, 0, glm::radians(60.0f), 0}), 1u);
    EXPECT_EQ(layers(scene::SpotLight{{0, 3, 0}, {0, -1, 0}, 0, glm::radians(61.0f), 0}), 6u);
    EXPECT_EQ(layers(scene::PointLight{}), 6u);
    EXPECT_EQ(layers(scene::RectLight{}), 6u);
    EXPECT_EQ(layers(scene::DiskLight{}), 6u);
}

TEST(LightMapFit, CubeFacesCoverAllDirectionsWithTheirRim)
{
    const scene::Scene scene = balls();
    const scene::View view = scene::make_view(scene::fit_camera(scene.bounds()), picture, scene.bounds());
    scene::Light light;
    light.shape = scene::PointLight{{0.5f, 2, -0.25f}, 0.0f};
    for (const float guard : {0.0f, 1.5f, 9.0f}) {
        const shaders::LightMap map = fit_light_map(scene, scene.bounds(), view, light, {.size = 64, .guard_texels = guard});
        std::mt19937 random(7);
        std::normal_distribution<float> normal;
        double nearest_rim = 1.0;
        for (int i = 0; i < 20000; ++i) {
            const vec3 d = glm::normalize(vec3(normal(random), normal(random), normal(random)));
            const tests::MapPoint m = project(map.layers[select_layer(map, map.centre + 2.0f * d)], map.centre + 2.0f * d);
            ASSERT_GT(m.w, 0.0);
            ASSERT_NEAR(m.depth, 2.0 * double(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)})), 1e-5);
            nearest_rim = std::min({nearest_rim, m.uv.x, m.uv.y, 1.0 - m.uv.x, 1.0 - m.uv.y});
        }
        EXPECT_NEAR(nearest_rim * 64.0, double(guard), 0.1);
    }
}

TEST(LightMapFit, TetrahedronFacesCoverAllDirectionsWithTheirRim)
{
    const scene::Scene scene = balls();
    const scene::View view = scene::make_view(scene::fit_camera(scene.bounds()), picture, scene.bounds());
    scene::Light light;
    light.shape = scene::PointLight{{0.5f, 2, -0.25f}, 0.0f};
    for (const float guard : {0.0f, 1.5f, 9.0f}) {
        const shaders::LightMap map = fit_light_map(scene, scene.bounds(), view, light,
            {.size = 64, .fitting = {.point_layout = int(PointLayout::tetrahedron)}, .guard_texels = guard});
        ASSERT_EQ(map.layer_count, 4u);
        std::mt19937 random(7);
        std::normal_distribution<float> normal;
        glm::dvec2 least(1.0), most(0.0);
        double shallowest = 1.0;
        std::array<int, 4> seen{};
        for (int i = 0; i < 200000; ++i) {
            const vec3 d = glm::normalize(vec3(normal(random), normal(random), normal(random)));
            const int face = select_layer(map, map.centre + 2.0f * d);
            const tests::MapPoint m = project(map.layers[face], map.centre + 2.0f * d);
            ASSERT_TRUE(m.inside);
            ++seen[size_t(face)];
            least = glm::min(least, m.uv), most = glm::max(most, m.uv), shallowest = std::min(shallowest, 0.5 * m.depth);
        }
        EXPECT_NEAR(shallowest, 1.0 / 3.0, 0.01); // 70.5 degrees from a face's axis
        for (const int n : seen) EXPECT_NEAR(n, 50000, 1000);
        // as tight as can be: the triangles touch all four sides of the square, less the guard
        for (const double rim : {least.x, least.y, 1.0 - most.x, 1.0 - most.y}) {
            EXPECT_GE(rim * 64.0, double(guard) - 0.01);
            EXPECT_LE(rim * 64.0, double(guard) + 1.0);
        }
    }
}

TEST(LightMapFit, ATetrahedronsTexelsAreAsWideAsTheySayAndItsDepthsAgree)
{
    const scene::Scene scene = balls();
    const scene::View view = scene::make_view(scene::fit_camera(scene.bounds()), picture, scene.bounds());
    for (const char* text : {"point,position=0.5/2/-0.25,radius=0", "spot,position=0/3/0,target=1/0/0,cone=150,radius=0"}) {
        const shaders::LightMap map = fit_light_map(scene, scene.bounds(), view, scene::parse_light(text, {}, scene.bounds()),
            {.size = 256, .fitting = {.point_layout = int(PointLayout::tetrahedron)}});
        ASSERT_EQ(map.layout_kind, uint32_t(LIGHT_MAP_TETRAHEDRON));
        expect_consistent(map, all_vertices(scene));
        for (int face = 0; face < 4; ++face) {
            const shaders::LightMapLayer& layer = map.layers[face];
            const vec3 axis(layer.depth_plane), side = glm::normalize(glm::cross(axis, vec3(0, 1, 0)));
            for (const vec3 across : {side, glm::cross(axis, side)}) {
                const vec3 p = map.centre + 3.0f * axis;
                const glm::dvec2 step = project(layer, p + 0.1f * across).uv - project(layer, p).uv;
                EXPECT_NEAR(glm::length(step) * 256.0 * double(layer.texel_metres) * 3.0, 0.1, 1e-4);
            }
            // 2.37 times those of a cube's faces, less the guard
            EXPECT_NEAR(double(layer.texel_metres) * (256.0 - 3.0), 4.732, 0.001);
        }
    }
}

TEST(LightMapFit, ACubeStandsAsItsPanelDoes)
{
    const Bounds bounds{{-2, 0, -2}, {2, 3, 2}};
    const scene::View view = scene::make_view(scene::fit_camera(bounds), picture, bounds);
    for (const char* text : {"rect,position=0/2/0,target=0/0/0,width=0.5,height=0.2",
             "rect,position=1/2/-0.3,target=-1/0.5/0.7,width=2,height=1", "rect,position=0.5/1/0,target=2/1/0",
             "disk,position=1/2/-0.3,target=-1/0.5/0.7,radius=0.4", "disk,position=0/2/0,target=0/0/0"}) {
        const scene::Light light = scene::parse_light(text, {}, bounds);
        const shaders::LightMap map = fit_light_map({}, bounds, view, light, {.size = 64});
        const shaders::LightMapLayer& ahead = map.layers[4]; // +z
        const auto* rect = std::get_if<scene::RectLight>(&light.shape);
        const vec3 normal = rect ? glm::normalize(glm::cross(rect->half_u, rect->half_v)) : std::get<scene::DiskLight>(light.shape).normal;
        EXPECT_LT(glm::length(vec3(ahead.depth_plane) - normal), 1e-6f) << text;
        EXPECT_EQ(select_layer(map, map.centre + normal), 4) << text;
        EXPECT_EQ(select_layer(map, map.centre - normal), 5) << text;
        if (!rect) continue;
        for (const vec3 side : {rect->half_u, rect->half_v}) {
            const glm::dvec2 step
                = project(ahead, map.centre + normal + 0.1f * glm::normalize(side)).uv - project(ahead, map.centre + normal).uv;
            EXPECT_LT(std::min(std::abs(step.x), std::abs(step.y)), 1e-6) << text;
            EXPECT_NEAR(glm::length(step) * 64.0 * double(ahead.texel_metres), 0.1, 1e-5) << text;
        }
    }
}

TEST(LightMapFit, ACornerOfTheSceneTowardsTheLightIsNotClipped)
{
    const Bounds bounds{{-2, 0, -2}, {2, 3, 2}};
    const scene::View view = scene::make_view(scene::fit_camera(bounds), picture, bounds);
    for (const float away : {0.01f, 1.0f, 100.0f}) {
        // along the diagonal, where the depth along a face's axis is 1/sqrt(3) of the distance
        scene::Light light;
        light.shape = scene::PointLight{bounds.max + away, 0.0f};
        expect_held(fit_light_map({}, bounds, view, light, {.size = 64}), {bounds.max, bounds.min}, "point light");
        light.shape = scene::SpotLight{bounds.max + away, vec3(0, 0, -1), 0.0f, glm::radians(60.0f), 0.0f};
        expect_held(fit_light_map({}, bounds, view, light, {.size = 64}), {bounds.max}, "spot");
    }
}

TEST(LightMapFit, AStepOfATexelIsATexel)
{
    const scene::Scene scene = balls();
    const scene::View view = scene::make_view(scene::fit_camera(scene.bounds()), picture, scene.bounds());
    for (const char* text : {"sun,elevation=40,azimuth=10", "point,position=0.5/2/0.5", "spot,position=2/5/1,target=0/0/0,cone=70"}) {
        const shaders::LightMap map
            = fit_light_map(scene, scene.bounds(), view, scene::parse_light(text, {}, scene.bounds()), {.size = 256});
        for (uint32_t i = 0; i < map.layer_count; ++i) {
            const shaders::LightMapLayer& layer = map.layers[i];
            const vec3 axis(layer.depth_plane);
            const vec3 start = map.centre + 3.0f * axis,
                       across = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
            const tests::MapPoint a = project(layer, start);
            const tests::MapPoint b = project(layer, start + across * (layer.texel_metres * (layer.perspective ? float(a.depth) : 1.0f)));
            EXPECT_NEAR(glm::length(b.uv - a.uv) * 256.0, 1.0, 1e-3) << text;
        }
    }
}

struct Odd {
    const char* name;
    scene::Camera camera;
    base::Size size;
    vec3 sun;
};

std::vector<Odd> odd_views()
{
    const vec3 forward = glm::normalize(vec3(0, 1, 0) - vec3(0, 3, 8));
    return {{"along the view", {"", {0, 3, 8}, {0, 1, 0}}, picture, forward},
        {"against the view", {"", {0, 3, 8}, {0, 1, 0}}, picture, -forward},
        {"from below", {"", {0, 3, 8}, {0, 1, 0}}, picture, vec3(0, 1, 0)},
        {"nearly straight down", {"", {0, 3, 8}, {0, 1, 0}}, picture, glm::normalize(vec3(1e-4f, -1, 0))},
        {"down along a view straight down", {"", {0, 9, 0}, {0, 0, 0}}, picture, vec3(0, -1, 0)},
        {"one pixel", {"", {0, 3, 8}, {0, 1, 0}}, {1, 1}, glm::normalize(vec3(1, -2, 0.5f))},
        {"a sliver", {"", {0, 3, 8}, {0, 1, 0}}, {4096, 1}, glm::normalize(vec3(1, -2, 0.5f))},
        {"a narrow view", {"", {0, 3, 8}, {0, 1, 0}, {0, 1, 0}, 1e-3f}, picture, glm::normalize(vec3(1, -2, 0.5f))},
        {"an orthographic view", {"", {4, 3, 8}, {0, 1, 0}, {0, 1, 0}, 0.9f, 2.0f}, picture, glm::normalize(vec3(1, -2, 0.5f))},
        {"an orthographic view along the light", {"", {4, 3, 8}, {0, 1, 0}, {0, 1, 0}, 0.9f, 2.0f}, picture,
            glm::normalize(vec3(-4, -2, -8))},
        {"an eye inside a ball", {"", {0, 0.5f, 0}, {1, 0.5f, 0}}, picture, glm::normalize(vec3(1, -2, 0.5f))}};
}

TEST(LightMapFit, OddViewsKeepTheirReceivers)
{
    const scene::Scene scene = balls();
    const Bounds bounds = scene.bounds();
    for (const Odd& odd : odd_views()) {
        SCOPED_TRACE(odd.name);
        const scene::View view = scene::make_view(odd.camera, odd.size, bounds);
        scene::Light light;
        light.shape = scene::DirectionalLight{odd.sun, 0.0f};
        for (const int size : {16, 1024}) {
            for (const shaders::FitParams& fitting : {shaders::FitParams{.fit = int(Fit::focused)},
                     {.fit = int(Fit::cascades), .stable = 0}, {.fit = int(Fit::cascades), .cascades = 8, .split = 1, .stable = 1}}) {
                const shaders::LightMap map = fit_light_map(scene, bounds, view, light, {.size = size, .fitting = fitting});
                expect_consistent(map, {});
                expect_held(map, visible_points(scene, view), odd.name);
            }
        }
    }
}

TEST(LightMapFit, AViewThatSeesNothingStillHasAMap)
{
    const scene::Scene scene = balls();
    const Bounds bounds = scene.bounds();
    const scene::View away = scene::make_view({"", {0, 3, 80}, {0, 3, 160}}, picture, bounds);
    EXPECT_TRUE(visible_part(away, bounds).empty());
    for (const Fit fit : {Fit::focused, Fit::cascades})
        for (const int stable : {0, 1})
            expect_consistent(
                fit_light_map(scene, bounds, away, scene::parse_light("sun", {}, bounds), {.fitting = {.fit = int(fit), .stable = stable}}),
                {});
}

TEST(LightMapFit, FlatAndPointLikeScenesHaveAMap)
{
    const vec3 low(-2, 1, -2), high(2, 1, 2);
    for (const Bounds& bounds : {Bounds{low, high}, Bounds{low, low}, Bounds{{0, 0, 0}, {0, 5, 0}}})
        for (const char* text : {"sun,elevation=90", "sun,elevation=1", "point,position=0/3/0", "spot,position=0/3/0,target=0/0/0"}) {
            const scene::View view = scene::make_view({"", {0, 4, 6}, {0, 1, 0}}, picture, bounds);
            for (const Fit fit : {Fit::focused, Fit::cascades})
                expect_consistent(
                    fit_light_map({}, bounds, view, scene::parse_light(text, {}, bounds), {.fitting = {.fit = int(fit)}}), {});
        }
}

TEST(LightMapClip, TheVisiblePartIsInBoxAndFrustumAndHoldsWhatIsSeen)
{
    const Bounds box{{-3, 0, -3}, {3, 2, 3}};
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (int i = 0; i < 200; ++i) {
        const vec3 eye(6 * uniform(random), 4 * uniform(random), 6 * uniform(random)),
            target(2 * uniform(random), 1 + uniform(random), 2 * uniform(random));
        scene::Camera camera{"", eye, target, {0, 1, 0}, 0.3f + 0.9f * std::abs(uniform(random)), i % 3 == 0 ? 1.5f : 0.0f};
        const scene::View view = scene::make_view(camera, picture, box);
        Bounds part;
        const std::vector<vec3> points = visible_part(view, box);
        const Planes planes = frustum_planes(view.clip_from_world);
        for (const vec3 p : points) {
            part.add(p);
            for (int k = 0; k < 3; ++k) {
                ASSERT_GE(p[k], box.min[k] - 2e-3f);
                ASSERT_LE(p[k], box.max[k] + 2e-3f);
            }
            for (const vec4& plane : planes) ASSERT_GE(glm::dot(plane, vec4(p, 1)) / glm::length(vec3(plane)), -5e-3f);
        }
        for (int k = 0; k < 500; ++k) {
            const vec3 p(3 * uniform(random), 1 + uniform(random), 3 * uniform(random));
            const vec4 clip = view.clip_from_world * vec4(p, 1);
            if (!(clip.w > 0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z > 0 && clip.z < clip.w)) continue;
            ASSERT_FALSE(part.empty()) << "a point that is seen, of a part that is empty";
            for (int a = 0; a < 3; ++a) {
                ASSERT_GE(p[a], part.min[a] - 1e-3f);
                ASSERT_LE(p[a], part.max[a] + 1e-3f);
            }
        }
    }
}

} // namespace
} // namespace gnomon::shadow::parts
