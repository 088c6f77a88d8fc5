// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "truth/benchmark.h"
#include "truth/truth.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

using namespace gnomon;
using namespace truth_test;

namespace {

const scene::Light sun = light_of(scene::DirectionalLight{glm::normalize(vec3(0.3f, -1, 0.2f)), 0.0f});

double mean(const base::Picture& p)
{
    double sum = 0;
    for (const float v : p.values) sum += double(v);
    return sum / double(p.values.size());
}

size_t background(const truth::Primary& p) { return size_t(std::count(p.primitive.begin(), p.primitive.end(), truth::no_primitive)); }

scene::Scene closed_box(bool double_sided)
{
    const vec3 a(-1), b(1);
    std::vector<scene::Mesh> sides; // all front sides point into the box
    sides.push_back(quad({a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z}));
    sides.push_back(quad({a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}));
    sides.push_back(quad({a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}));
    sides.push_back(quad({b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z}));
    sides.push_back(quad({a.x, a.y, b.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z}));
    sides.push_back(quad({b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}));
    scene::Scene s = scene_of(std::move(sides));
    s.materials[0].double_sided = double_sided;
    return s;
}

} // namespace

TEST(TruthRays, primary_gives_depth_position_normal_and_primitive)
{
    const scene::Scene s = scene_of({level_quad(-5, 5, -5, 5, 0), level_quad(-1, 1, -1, 1, 1)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {0, 2, 5}, {0, 1, 0}, {65, 49});
    const truth::Primary p = tracer.primary(view);
    for (int y = 0; y < 49; ++y)
        for (int x = 0; x < 65; ++x) {
            const size_t i = size_t(y) * 65 + size_t(x);
            const vec3 position(p.position.at(x, y, 0), p.position.at(x, y, 1), p.position.at(x, y, 2));
            if (p.primitive[i] == truth::no_primitive) {
                ASSERT_EQ(p.depth.at(x, y), 0.0f);
                continue;
            }
            ASSERT_EQ(position.y, p.primitive[i] < 2 ? 0.0f : 1.0f);
            ASSERT_EQ(vec3(p.normal.at(x, y, 0), p.normal.at(x, y, 1), p.normal.at(x, y, 2)), vec3(0, 1, 0));
            // The G-buffer's way back: project the position, find the pixel's centre and the depth again.
            const vec4 clip = view.clip_from_world * vec4(position, 1.0f);
            ASSERT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * 65.0f, float(x) + 0.5f, 1e-3f);
            ASSERT_NEAR((clip.y / clip.w * 0.5f + 0.5f) * 49.0f, float(y) + 0.5f, 1e-3f);
            ASSERT_NEAR(p.depth.at(x, y), clip.w, 1e-5f);
        }
    EXPECT_EQ(p.primitive[24 * 65 + 32] / 2, 1u) << "the small quad is in the middle";
    EXPECT_GT(background(p), 0u);
}

TEST(TruthRays, orthographic_cameras_and_the_near_plane)
{
    const scene::Scene s = scene_of({level_quad(-5, 5, -5, 5, 0), level_quad(-5, 5, -5, 5, 2)});
    const truth::Tracer tracer(s);
    scene::Camera c;
    c.eye = {0, 3, 0}, c.target = {0, 0, 0}, c.up = {0, 0, -1}, c.half_height = 1.0f, c.near = 0.5f;
    const auto centre = [&] {
        const truth::Primary p = tracer.primary(scene::make_view(c, {8, 8}, s.bounds()));
        EXPECT_EQ(background(p), 0u);
        return p.depth.at(4, 4);
    };
    EXPECT_NEAR(centre(), 1.0f, 1e-5f);
    c.near = 1.5f; // cuts the upper quad away
    EXPECT_NEAR(centre(), 3.0f, 1e-5f);
    c.half_height = 0.0f;
    EXPECT_NEAR(centre(), 3.0f, 1e-5f);
    c.near = 0.5f;
    EXPECT_NEAR(centre(), 1.0f, 1e-5f);
}

TEST(TruthRays, a_plane_is_lit_everywhere_and_so_is_the_background)
{
    const scene::Scene s = scene_of({level_quad(-5, 5, -5, 5, 0)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {0, 4, 6}, {0, 0, 0});
    const truth::Primary p = tracer.primary(view);
    truth::Settings settings;
    settings.samples = 16;
    for (const scene::LightShape& shape :
        {scene::LightShape(std::get<scene::DirectionalLight>(sun.shape)), scene::LightShape(scene::DirectionalLight{vec3(0, -1, 0), 0.05f}),
            scene::LightShape(scene::PointLight{vec3(1, 3, 0), 0.0f}), scene::LightShape(scene::PointLight{vec3(1, 3, 0), 0.3f}),
            scene::LightShape(scene::RectLight{vec3(1, 3, 0), vec3(1, 0, 0), vec3(0, 0, 1)}),
            scene::LightShape(scene::DiskLight{vec3(1, 3, 0), vec3(0, -1, 0), 1.0f})}) {
        const truth::Visibility v = tracer.visibility(view, p, light_of(shape), settings);
        EXPECT_EQ(*std::min_element(v.mean.values.begin(), v.mean.values.end()), 1.0f) << shape.index();
        EXPECT_EQ(*std::max_element(v.variance.values.begin(), v.variance.values.end()), 0.0f);
        EXPECT_EQ(v.samples, light_of(shape).soft() ? 16 : 1);
    }
}

TEST(TruthRays, nothing_comes_into_a_closed_box)
{
    for (const bool double_sided : {false, true}) {
        const scene::Scene s = closed_box(double_sided);
        const truth::Tracer tracer(s);
        // Near a corner, so that many rays pass close to edges shared by two sides.
        const scene::View view = look(s, {0.9f, 0.8f, 0.7f}, {-1, -1, -1}, {128, 128}, 100.0f);
        const truth::Primary p = tracer.primary(view);
        EXPECT_EQ(background(p), 0u);
        truth::Settings settings;
        settings.samples = 16;
        for (const scene::Light& light : {sun, light_of(scene::PointLight{vec3(3, 5, 2), 0.5f})}) {
            const truth::Visibility v = tracer.visibility(view, p, light, settings);
            EXPECT_EQ(*std::max_element(v.mean.values.begin(), v.mean.values.end()), 0.0f);
        }
    }
}

TEST(TruthRays, nothing_comes_through_the_edges_of_small_triangles)
{
    // 50,000 triangles seen from inside: among two million rays many meet an edge or a corner to the last bit.
    scene::Scene s = scene_of({sphere(vec3(0), 1.0f, 128, 192)});
    s.instances[0].world_from_object = glm::translate(glm::rotate(mat4(1), 0.7f, glm::normalize(vec3(1, 2, 3))), vec3(7, 3, 5));
    const truth::Tracer tracer(s);
    const vec3 centre(s.instances[0].world_from_object[3]);
    const scene::View view = look(s, centre, centre + vec3(0.3f, 0.9f, 0.2f), {256, 256}, 110.0f);
    const truth::Primary p = tracer.primary(view);
    EXPECT_EQ(background(p), 0u);
    truth::Settings settings;
    settings.samples = 36;
    const truth::Visibility v = tracer.visibility(view, p, light_of(scene::PointLight{centre + vec3(3, 1, 2), 1.0f}), settings);
    EXPECT_EQ(*std::max_element(v.mean.values.begin(), v.mean.values.end()), 0.0f);
}

TEST(TruthRays, single_sided_back_faces_are_unseen_but_block_light)
{
    scene::Scene s = scene_of({level_quad(-5, 5, -5, 5, 0), level_quad(-5, 5, -5, 5, 2, 1)}, {{}, {}});
    const scene::View from_below = look(s, {0, 1, 0.1f}, {0, 2, 0}, {16, 16}, 30.0f);
    const auto seen = [&](const scene::View& view) {
        const truth::Tracer tracer(s);
        const truth::Primary p = tracer.primary(view);
        return std::make_pair(background(p), mean(tracer.visibility(view, p, sun, {}).mean));
    };
    EXPECT_EQ(seen(from_below).first, 256u) << "the back face of a single-sided material was seen";
    s.materials[1].double_sided = true;
    EXPECT_EQ(seen(from_below).first, 0u);
    EXPECT_EQ(seen(from_below).second, 0.0) << "the sun is above, the visible side below";
    s.materials[1].double_sided = false;
    const scene::View of_the_floor = look(s, {0, 1, 0.1f}, {0, 0, 0}, {16, 16}, 30.0f);
    EXPECT_EQ(seen(of_the_floor), (std::pair<size_t, double>(0, 0.0))) << "a single-sided caster blocks light all the same";
}

TEST(TruthRays, a_front_face_in_the_place_of_a_back_face_is_seen)
{
    // Leaves are often two single-sided quads back to back in one place.
    std::vector<scene::Mesh> both{level_quad(-1, 1, -1, 1, 1), level_quad(-1, 1, -1, 1, 1)};
    for (size_t i = 0; i < both[1].indices.size(); i += 3) std::swap(both[1].indices[i], both[1].indices[i + 1]);
    for (int order = 0; order < 2; ++order) {
        const scene::Scene s = scene_of(both, {{}});
        const truth::Tracer tracer(s);
        for (const float y : {4.0f, -2.0f}) {
            const truth::Primary p = tracer.primary(look(s, {0.2f, y, 0.1f}, {0, 1, 0}, {32, 32}, 20.0f));
            const uint32_t front = (y > 1) == (order == 0) ? 0 : 1;
            EXPECT_EQ(size_t(std::count_if(p.primitive.begin(), p.primitive.end(), [&](uint32_t id) { return id / 2 == front; })),
                p.primitive.size());
        }
        std::swap(both[0], both[1]);
    }
}

TEST(TruthRays, instancing_gives_what_flattening_gives)
{
    scene::Scene s = scene_of({level_quad(-6, 6, -6, 6, 0), sphere(vec3(0), 0.6f, 12, 16, 1)}, {{}, {}});
    s.instances.clear();
    s.instances.push_back({0, mat4(1)});
    for (int i = 0; i < 5; ++i) {
        mat4 m = glm::translate(mat4(1), vec3(float(i) - 2, 1.0f + 0.2f * float(i), 0.3f * float(i)));
        m = glm::rotate(m, 0.7f * float(i), glm::normalize(vec3(1, 2, 3)));
        s.instances.push_back({1, glm::scale(m, i == 2 ? vec3(1, 0, 1) : vec3(1, 0.5f + 0.2f * float(i), 1))});
    }
    const truth::Tracer flat(s), instanced(s, 0);
    const scene::View view = look(s, {1, 4, 6}, {0, 0.5f, 0}, {96, 64});
    const truth::Primary a = flat.primary(view), b = instanced.primary(view);
    size_t different = 0;
    for (size_t i = 0; i < a.primitive.size(); ++i) different += a.primitive[i] != b.primitive[i];
    EXPECT_LE(different, 6u) << "rays at the very edges of triangles may differ by rounding, others may not";
    const truth::Visibility va = flat.visibility(view, a, sun, {}), vb = instanced.visibility(view, b, sun, {});
    different = 0;
    for (size_t i = 0; i < va.mean.values.size(); ++i) different += va.mean.values[i] != vb.mean.values[i];
    EXPECT_LE(different, 6u);
    EXPECT_LT(mean(va.mean), 0.97);
}

TEST(TruthRays, one_and_two_threads_give_the_same_bits)
{
    const scene::Scene s = scene_of({level_quad(-6, 6, -6, 6, 0), sphere(vec3(0, 1, 0), 0.6f, 24, 32)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {1, 4, 6}, {0, 0.5f, 0}, {97, 61});
    const scene::Light light = light_of(scene::PointLight{vec3(1, 4, 1), 0.5f});
    truth::Settings one, two;
    one.samples = two.samples = 30; // becomes 36
    one.threads = 1, two.threads = 2;
    const truth::Primary a = tracer.primary(view, 1), b = tracer.primary(view, 2);
    EXPECT_EQ(a.primitive, b.primitive);
    EXPECT_EQ(a.position.values, b.position.values);
    const truth::Visibility va = tracer.visibility(view, a, light, one), vb = tracer.visibility(view, b, light, two);
    EXPECT_EQ(va.mean.values, vb.mean.values);
    EXPECT_EQ(va.variance.values, vb.variance.values);
    EXPECT_EQ(va.samples, 36);
    two.seed = 2;
    EXPECT_NE(tracer.visibility(view, b, light, two).mean.values, va.mean.values);
}

TEST(TruthRays, variance_foretells_the_scatter_between_seeds)
{
    const scene::Scene s = scene_of({level_quad(-6, 6, -6, 6, 0), level_quad(-0.5f, 0.5f, -0.5f, 0.5f, 1)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {0, 5, 0.1f}, {0, 0, 0}, {48, 48});
    const truth::Primary p = tracer.primary(view);
    const scene::Light light = light_of(scene::RectLight{vec3(0, 3, 0), vec3(0.7f, 0.1f, 0), vec3(0, 0, 0.7f)});
    truth::Settings settings;
    double scatter = 0, foretold = 0;
    settings.samples = 25; // odd: one stratum is left over
    const truth::Visibility first = tracer.visibility(view, p, light, settings);
    settings.seed = 99;
    const truth::Visibility second = tracer.visibility(view, p, light, settings);
    for (size_t i = 0; i < first.mean.values.size(); ++i) {
        const double d = double(first.mean.values[i]) - double(second.mean.values[i]);
        scatter += d * d / 2;
        foretold += 0.5 * double(first.variance.values[i] + second.variance.values[i]);
    }
    EXPECT_GT(scatter, 0.0);
    EXPECT_GT(foretold, 1.2 * scatter) << "the estimate must not be too small";
    EXPECT_LT(foretold, 3.0 * scatter) << "nor useless";
}

TEST(TruthRays, bad_scenes_and_lights_end_in_a_sentence)
{
    scene::Scene s = scene_of({level_quad(-1, 1, -1, 1, 0)});
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {0, 3, 3}, {0, 0, 0}, {8, 8});
    const truth::Primary p = tracer.primary(view);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(tracer.visibility(view, p, light_of(scene::PointLight{vec3(0, nan, 0), 0.0f}), {}), base::Error);
    EXPECT_THROW(tracer.visibility(view, p, light_of(scene::DirectionalLight{vec3(nan), 0.0f}), {}), base::Error);
    s.meshes[0].positions[2].x = nan;
    EXPECT_THROW(truth::Tracer{s}, base::Error);
    s.meshes[0].positions[2].x = 1e30f;
    EXPECT_THROW(truth::Tracer{s}, base::Error);
    const scene::Scene empty = scene_of({});
    const truth::Tracer of_nothing(empty);
    EXPECT_EQ(background(of_nothing.primary(view)), 64u);
}

TEST(TruthRays, a_light_in_the_plane_or_on_the_surface_is_no_trouble)
{
    const scene::Scene s = scene_of({level_quad(-1, 1, -1, 1, 0)});
    const truth::Tracer tracer(s);
    const std::vector<vec3> points(1, vec3(0.1f, 0, 0.2f)), up(1, vec3(0, 1, 0));
    EXPECT_EQ(tracer.visibility_at(points, up, light_of(scene::PointLight{points[0], 0.0f}), {})[0], 0.0);
    EXPECT_EQ(tracer.visibility_at(points, up, light_of(scene::PointLight{vec3(0.5f, 0, 0.5f), 0.0f}), {})[0], 0.0)
        << "not in front of the plane";
    EXPECT_EQ(tracer.visibility_at(points, up, light_of(scene::PointLight{points[0] + vec3(0, 1e-9f, 0), 0.0f}), {})[0], 1.0);
    EXPECT_EQ(tracer.visibility_at(points, up, light_of(scene::DirectionalLight{vec3(1, 0, 0), 0.0f}), {})[0], 0.0);
}

TEST(TruthRays, keeps_near_embrees_own_time)
{
    if (std::getenv("GNOMON_TIMING") == nullptr) GTEST_SKIP() << "times on a shared machine say little; set GNOMON_TIMING=1 to measure";
    std::vector<scene::Mesh> meshes{level_quad(-8, 8, -8, 8, 0)};
    for (int i = 0; i < 25; ++i) meshes.push_back(sphere(vec3(float(i % 5) * 2 - 4, 1, float(i / 5) * 2 - 4), 0.8f, 45, 45));
    const scene::Scene s = scene_of(std::move(meshes));
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {0, 6, 9}, {0, 0, 0}, {1024, 768});
    const scene::Light light = light_of(scene::SpotLight{vec3(3, 8, 3), glm::normalize(vec3(-3, -8, -3)), 0.9f, 1.0f, 0.0f});
    const truth::RawThroughput raw = truth::raw_packets(tracer, view, light);
    double best = 1e9;
    for (int run = 0; run < 5; ++run) {
        const auto begin = std::chrono::steady_clock::now();
        const truth::Primary p = tracer.primary(view);
        const auto middle = std::chrono::steady_clock::now();
        const truth::Visibility v = tracer.visibility(view, p, light, {});
        const auto end = std::chrono::steady_clock::now();
        const double primary = std::chrono::duration<double, std::milli>(middle - begin).count(),
                     shadow = std::chrono::duration<double, std::milli>(end - middle).count();
        best = std::min(best, primary + shadow);
        std::printf("primary %.1f ms (raw %.1f), shadow %.1f ms (raw %.1f)\n", primary, raw.primary_ms, shadow, raw.shadow_ms);
    }
    EXPECT_LT(best, 1.75 * (raw.primary_ms + raw.shadow_ms));
}
