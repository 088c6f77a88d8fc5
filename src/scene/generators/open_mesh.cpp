// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/noise.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

int sheet(Stage& stage, std::string name, vec3 base)
{
    const int m = stage.material(std::move(name), base, 0.55f);
    stage.edit(m).double_sided = true;
    return m;
}

/// Half a sphere without a bottom; the axis is y.
void add_shell(MeshBuilder& b, float radius)
{
    b.patch(
        32, 10,
        [&](float u, float v) {
            const float a = 2.0f * pi * u, r = v >= 1.0f ? 0.0f : std::cos(0.5f * pi * v);
            const vec3 n(r * std::cos(a), std::sin(0.5f * pi * v), -r * std::sin(a));
            return Vertex{radius * n, n, vec2(u, v)};
        },
        true);
}

/// A strip with one half twist: it has one side, so that no orientation of its faces is right and its normals turn over at the seam.
void add_moebius(MeshBuilder& b, float radius, float half_width)
{
    const auto at_angle = [&](float a, float s) {
        const float r = radius + s * std::cos(0.5f * a);
        return vec3(r * std::cos(a), s * std::sin(0.5f * a), r * std::sin(a));
    };
    b.patch(72, 3, [&](float u, float v) {
        const float a = 2.0f * pi * u, s = (2.0f * v - 1.0f) * half_width;
        const vec3 along = at_angle(a + 0.01f, s) - at_angle(a - 0.01f, s), across = at_angle(a, s + 0.01f) - at_angle(a, s - 0.01f);
        return Vertex{at_angle(a, s), glm::normalize(glm::cross(along, across)), vec2(6.0f * u, v)};
    });
}

void add_ribbon(MeshBuilder& b, float turns, float width)
{
    b.patch(96, 1, [&](float u, float v) {
        const float a = 2.0f * pi * turns * u, r = 0.45f - 0.15f * u;
        return Vertex{{r * std::cos(a), 1.7f * u + width * v, r * std::sin(a)}, {std::cos(a), 0, std::sin(a)}, {8.0f * u, v}};
    });
}

/// Faces that share an edge by three and four, and one triangle that is there twice.
void add_non_manifold(MeshBuilder& b)
{
    for (int i = 0; i < 5; ++i) {
        const float a = glm::radians(72.0f * float(i) + 10.0f);
        b.quad({0, 0, 0}, {0.55f * std::cos(a), 0, 0.55f * std::sin(a)}, {0, 0.9f, 0});
    }
    for (int i = 0; i < 2; ++i) b.flat_triangle({-0.35f, 0.95f, 0.1f}, {0.35f, 0.95f, 0.1f}, {0, 1.5f, -0.15f});
}

} // namespace

Scene open_mesh(double detail)
{
    Stage stage("open_mesh", detail);
    const int slab = stage.texture(mottled("slab", {0.68f, 0.67f, 0.64f}, 0.12f, 8, 31));
    MeshBuilder floor = stage.builder(stage.material("slab", vec3(0.9f), 0.9f, slab), 0.3f);
    floor.box({0, -0.1f, 0}, {5, 0.1f, 4}, 0.02f);
    stage.add("floor", std::move(floor));

    MeshBuilder shell = stage.builder(sheet(stage, "shell", {0.7f, 0.34f, 0.14f}));
    add_shell(shell, 0.6f);
    const int shell_mesh = stage.mesh("shell", std::move(shell));
    stage.place(shell_mesh, at({-1.9f, 0, 0.9f}));
    stage.place(shell_mesh, at({-0.75f, 0.42f, 1.35f}) * turned(140, vec3(1, 0, 0.3f)) * scaled(vec3(0.7f)));
    stage.place(shell_mesh, at({-2.6f, 0.75f, -0.9f}) * turned(-75, vec3(1, 0, 0)) * scaled(vec3(1.15f)));

    MeshBuilder moebius = stage.builder(sheet(stage, "moebius", {0.1f, 0.36f, 0.5f}));
    moebius.transform = at({0.1f, 0.95f, -0.5f}) * turned(20) * turned(65, vec3(1, 0, 0));
    add_moebius(moebius, 0.65f, 0.24f);
    stage.add("moebius strip", std::move(moebius));
    MeshBuilder ribbon = stage.builder(sheet(stage, "ribbon", {0.6f, 0.12f, 0.2f}));
    ribbon.transform = at({1.75f, 0.02f, 0.5f});
    add_ribbon(ribbon, 3.5f, 0.2f);
    stage.add("ribbon", std::move(ribbon));
    MeshBuilder fan = stage.builder(sheet(stage, "fan", {0.28f, 0.45f, 0.2f}));
    fan.transform = at({2.9f, 0, -0.8f});
    add_non_manifold(fan);
    stage.add("non-manifold fan", std::move(fan));

    MeshBuilder loose = stage.builder(sheet(stage, "loose triangles", {0.78f, 0.6f, 0.16f}));
    Random random(33);
    for (int i = 0; i < 40; ++i) {
        const vec3 p(random.between(-3.6f, 3.6f), random.between(0.1f, 2.2f), random.between(-2.6f, -1.6f));
        loose.transform = at(p) * turned(360.0f * random.next()) * turned(360.0f * random.next(), vec3(1, 0, 0));
        loose.flat_triangle({-0.14f, -0.08f, 0}, {0.14f, -0.08f, 0}, {0, 0.17f, 0});
    }
    stage.add("loose triangles", std::move(loose));
    stage.camera("three-quarter", {1.6f, 2.3f, 5.6f}, {0.1f, 0.55f, -0.2f}, 45);
    stage.camera("low", {-3.9f, 0.7f, 3.4f}, {0.2f, 0.65f, -0.3f}, 48);
    stage.sun("sun", 42, 50, 0.0f, {1.0f, 0.93f, 0.82f});
    stage.sun("soft sun", 42, 50, 2.0f, {1.0f, 0.93f, 0.82f});
    stage.spot("spot", {-2, 5, 3}, {0, 0.5f, 0}, 70, 0.1f);
    stage.point("lamp", {0.4f, 3.2f, 1.2f}, 0.12f, {1.0f, 0.86f, 0.68f});
    stage.disk("dish", {2.5f, 4, 2.5f}, {0, 0.5f, 0}, 0.6f);
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
