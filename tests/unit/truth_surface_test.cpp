// SPDX-License-Identifier: Apache-2.0
#include "truth/surface.h"
#include "truth/truth.h"
#include "truth_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace gnomon;
using namespace truth_test;

namespace {

const std::vector<vec3> up(1, vec3(0, 1, 0));

/// 2 x 2 texels: alpha 255 on one diagonal.
scene::Texture checker(bool linear, scene::Wrap wrap)
{
    scene::Texture t;
    t.width = t.height = 2;
    t.linear = linear, t.wrap_u = t.wrap_v = wrap;
    for (const int alpha : {255, 0, 0, 255})
        for (const int v : {255, 255, 255, alpha}) t.rgba.push_back(uint8_t(v));
    return t;
}

scene::Scene masked_scene(bool linear, scene::Wrap wrap = scene::Wrap::repeat)
{
    std::vector<scene::Material> materials(2);
    materials[1].alpha = scene::AlphaMode::mask;
    materials[1].base_color_texture.texture = 0;
    materials[1].double_sided = true;
    scene::Scene s = scene_of({level_quad(-4, 4, -4, 4, 0), level_quad(-1, 1, -1, 1, 1, 1)}, materials);
    s.textures.push_back(checker(linear, wrap));
    return s;
}

/// Panes one above the other, each of one colour and mode.
scene::Scene panes(const std::vector<scene::Material>& glass)
{
    std::vector<scene::Material> materials(1);
    std::vector<scene::Mesh> meshes{level_quad(-4, 4, -4, 4, 0)};
    for (const scene::Material& m : glass) {
        materials.push_back(m);
        meshes.push_back(level_quad(-2, 2, -2, 2, 0.5f * float(meshes.size()), int(meshes.size())));
    }
    return scene_of(std::move(meshes), std::move(materials));
}

scene::Material blended(vec4 color)
{
    scene::Material m;
    m.alpha = scene::AlphaMode::blend;
    m.base_color = color;
    return m;
}

vec3 through(const scene::Scene& s, const scene::Light& light)
{
    const truth::Tracer tracer(s);
    scene::Camera c;
    c.eye = {0, 0.3f, 0.1f}, c.target = {0, 0, 0}, c.near = 0.01f;
    const scene::View view = scene::make_view(c, {4, 4}, s.bounds());
    const truth::Primary p = tracer.primary(view);
    truth::Settings settings;
    settings.samples = 16;
    const truth::Visibility v = tracer.transmittance(view, p, light, settings);
    return {v.mean.at(2, 2, 0), v.mean.at(2, 2, 1), v.mean.at(2, 2, 2)};
}

void expect_near(vec3 a, vec3 b)
{
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-3f) << k;
}

} // namespace

TEST(TruthSurface, a_masked_caster_lets_light_through_its_holes)
{
    const scene::Scene s = masked_scene(false);
    const truth::Tracer tracer(s);
    const scene::Light down = light_of(scene::DirectionalLight{vec3(0, -1, 0), 0.0f});
    // uv = (0, 0) at (-1, +1); texels 0 and 3 (the diagonal u = v) are there.
    for (const auto& [x, z, expected] :
        {std::tuple(-0.5f, 0.5f, 0.0), {0.5f, -0.5f, 0.0}, {-0.5f, -0.5f, 1.0}, {0.5f, 0.5f, 1.0}, {1.5f, 0.5f, 1.0}})
        EXPECT_EQ(tracer.visibility_at({vec3(x, 0, z)}, up, down, {})[0], expected) << x << " " << z;
}

TEST(TruthSurface, a_masked_surface_is_seen_where_it_is)
{
    const scene::Scene s = masked_scene(false);
    const truth::Tracer tracer(s);
    scene::Camera c;
    c.eye = {0, 3, 0}, c.up = {0, 0, -1}, c.half_height = 1.0f;
    const truth::Primary p = tracer.primary(scene::make_view(c, {16, 16}, s.bounds()));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const bool there = (x < 8) != (y < 8); // row 0 is z = -1, which is v = 1
            EXPECT_EQ(p.position.at(x, y, 1), there ? 1.0f : 0.0f) << x << " " << y;
        }
}

TEST(TruthSurface, half_of_a_checkerboard_shades_half_of_the_light)
{
    const scene::Scene s = masked_scene(false);
    const truth::Tracer tracer(s);
    truth::Settings settings;
    settings.samples = 1024;
    // Seen from the point below its middle, the board fills the light exactly (height 1 of 2).
    const scene::Light light = light_of(scene::RectLight{vec3(0, 2, 0), vec3(2, 0, 0), vec3(0, 0, 2)});
    EXPECT_NEAR(tracer.visibility_at({vec3(0)}, up, light, settings)[0], 0.5, 1e-6);
}

TEST(TruthSurface, samples_as_a_gpu_does)
{
    scene::Texture t = checker(true, scene::Wrap::repeat);
    const auto alpha = [&](float u, float v) { return truth::sample(t, {u, v}).w; };
    EXPECT_FLOAT_EQ(alpha(0.25f, 0.25f), 1.0f) << "a texel's centre";
    EXPECT_FLOAT_EQ(alpha(0.75f, 0.25f), 0.0f);
    EXPECT_FLOAT_EQ(alpha(0.5f, 0.25f), 0.5f);
    EXPECT_FLOAT_EQ(alpha(0.375f, 0.25f), 0.75f);
    EXPECT_FLOAT_EQ(alpha(0.0f, 0.25f), 0.5f) << "the border wraps";
    EXPECT_FLOAT_EQ(alpha(-0.75f, 1.25f), 1.0f);
    t.wrap_u = t.wrap_v = scene::Wrap::clamp;
    EXPECT_FLOAT_EQ(alpha(0.0f, 0.25f), 1.0f);
    EXPECT_FLOAT_EQ(alpha(-7.0f, 0.25f), 1.0f);
    EXPECT_FLOAT_EQ(alpha(7.0f, 0.25f), 0.0f);
    t.wrap_u = t.wrap_v = scene::Wrap::mirror;
    EXPECT_FLOAT_EQ(alpha(-0.25f, 0.25f), 1.0f);
    EXPECT_FLOAT_EQ(alpha(1.25f, 0.25f), 0.0f);
    EXPECT_FLOAT_EQ(alpha(2.25f, 0.25f), 1.0f);
    t.linear = false;
    EXPECT_FLOAT_EQ(alpha(0.49f, 0.25f), 1.0f);
    for (const float bad : {std::nanf(""), 1e30f, -1e30f, std::numeric_limits<float>::infinity()})
        EXPECT_TRUE(std::isfinite(alpha(bad, bad)));
    t.rgba[0] = 128;
    EXPECT_NEAR(truth::sample(t, {0.25f, 0.25f}).x, 0.2158605f, 1e-6f) << "colours are decoded";
    t.srgb = false;
    EXPECT_NEAR(truth::sample(t, {0.25f, 0.25f}).x, 128.0f / 255.0f, 1e-6f);
}

TEST(TruthSurface, base_colour_multiplies_material_texture_and_vertices)
{
    scene::Scene s = masked_scene(false);
    scene::Mesh& mesh = s.meshes[1];
    mesh.colors = {0xff0000ffu, 0xff0000ffu, 0xff0000ffu, 0xff0000ffu}; // red, opaque
    s.materials[1].base_color = {0.5f, 0.5f, 0.5f, 0.5f};
    const truth::Surface surface{&s, &mesh, &s.materials[1]};
    EXPECT_EQ(truth::base_color(surface, 0, 0.1f, 0.1f), vec4(0.5f, 0, 0, 0.5f));
    EXPECT_EQ(truth::alpha(surface, 0, 0.1f, 0.1f), 0.5f);
    // Rotating the coordinates by 90 degrees swaps the diagonals.
    s.materials[1].base_color_texture.u_row = {0, -1, 1};
    s.materials[1].base_color_texture.v_row = {1, 0, 0};
    EXPECT_EQ(truth::alpha(surface, 0, 0.1f, 0.1f), 0.0f);
}

TEST(TruthSurface, blended_surfaces_are_neither_seen_nor_block_visibility)
{
    const scene::Scene s = panes({blended({1, 0, 0, 0.5f})});
    const truth::Tracer tracer(s);
    scene::Camera c;
    c.eye = {0, 3, 0}, c.up = {0, 0, -1};
    const truth::Primary p = tracer.primary(scene::make_view(c, {8, 8}, s.bounds()));
    EXPECT_EQ(p.position.at(4, 4, 1), 0.0f);
    EXPECT_EQ(tracer.visibility_at({vec3(0)}, up, light_of(scene::DirectionalLight{}), {})[0], 1.0);
}

TEST(TruthSurface, stacked_panes_multiply)
{
    const std::vector<vec4> colors{{1, 0.2f, 0.1f, 0.5f}, {0.3f, 0.9f, 0.4f, 0.25f}, {0.2f, 0.4f, 1, 0.75f}};
    std::vector<scene::Material> glass;
    vec3 expected(1);
    for (const vec4& color : colors) {
        glass.push_back(blended(color));
        expected *= scene::transmittance(glass.back(), color);
        for (const scene::LightShape& shape :
            {scene::LightShape(scene::DirectionalLight{glm::normalize(vec3(0.2f, -1, 0.1f)), 0.0f}),
                scene::LightShape(scene::PointLight{vec3(0.2f, 5, 0), 0.0f}), scene::LightShape(scene::PointLight{vec3(0.2f, 5, 0), 0.2f})})
            expect_near(through(panes(glass), light_of(shape)), expected);
    }
    scene::Material tinted;
    tinted.base_color = {0.9f, 0.8f, 0.7f, 1};
    tinted.transmission = 0.8f, tinted.thickness = 0.02f, tinted.attenuation_distance = 0.05f,
    tinted.attenuation_color = {0.5f, 0.9f, 0.7f};
    glass.push_back(tinted);
    expected *= scene::transmittance(tinted, tinted.base_color);
    EXPECT_GT(expected.x, 1e-3f);
    expect_near(through(panes(glass), light_of(scene::DirectionalLight{})), expected);
    glass.emplace_back(); // opaque
    expect_near(through(panes(glass), light_of(scene::DirectionalLight{})), vec3(0));
}

TEST(TruthSurface, many_panes_are_all_counted)
{
    const std::vector<scene::Material> glass(40, blended({1, 1, 1, 0.05f}));
    expect_near(through(panes(glass), light_of(scene::DirectionalLight{})), vec3(std::pow(0.95f, 40.0f)));
}

TEST(TruthSurface, rays_that_converge_from_all_octants_count_each_pane_once)
{
    const scene::Scene s = panes({blended({1, 1, 1, 0.5f})});
    const truth::Tracer tracer(s);
    scene::Camera c;
    c.eye = {0, 0.4f, 0}, c.target = {0, 0, 0}, c.up = {0, 0, -1}, c.half_height = 1.0f;
    const scene::View view = scene::make_view(c, {16, 16}, s.bounds());
    const truth::Primary p = tracer.primary(view);
    for (const float radius : {0.0f, 0.3f})
        for (const float v : tracer.transmittance(view, p, light_of(scene::PointLight{vec3(0.03f, 4, 0.02f), radius}), {}).mean.values)
            ASSERT_EQ(v, 0.5f);
}

TEST(TruthSurface, transmittance_without_glass_is_visibility)
{
    const scene::Scene s = masked_scene(true);
    const truth::Tracer tracer(s);
    const scene::View view = look(s, {1, 3, 3}, {0, 0, 0});
    const truth::Primary p = tracer.primary(view);
    truth::Settings settings;
    settings.samples = 16;
    const scene::Light light = light_of(scene::PointLight{vec3(0.2f, 5, 0), 0.2f});
    const truth::Visibility grey = tracer.visibility(view, p, light, settings), color = tracer.transmittance(view, p, light, settings);
    for (size_t i = 0; i < color.mean.values.size(); ++i) {
        ASSERT_EQ(color.mean.values[i], grey.mean.values[i / 3]);
        ASSERT_EQ(color.variance.values[i], grey.variance.values[i / 3]);
    }
    EXPECT_LT(*std::min_element(grey.mean.values.begin(), grey.mean.values.end()), 0.1f);
}
