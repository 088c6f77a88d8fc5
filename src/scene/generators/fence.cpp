// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/foliage.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

constexpr float panel = 3.0f, mesh_height = 3.2f;

struct Materials {
    int asphalt, paint, grass, mesh, steel, iron, board, net, wood, rubber, concrete;
};

Materials make_materials(Stage& s)
{
    Materials m{};
    m.asphalt = s.material("asphalt", vec3(0.6f), 0.95f, s.texture(mottled("asphalt", {0.56f, 0.57f, 0.6f}, 0.22f, 24, 121)));
    m.paint = s.material("line paint", {0.72f, 0.71f, 0.66f}, 0.8f);
    m.grass = s.material("grass", vec3(0.75f), 0.95f, s.texture(mottled("turf", {0.46f, 0.5f, 0.3f}, 0.4f, 12, 122)));
    const auto masked = [&](std::string name, int texture) {
        const int id = s.material(std::move(name), vec3(0.85f), 0.5f, texture);
        s.edit(id).alpha = AlphaMode::mask;
        s.edit(id).alpha_cutoff = 0.5f;
        s.edit(id).double_sided = true;
        return id;
    };
    m.mesh = masked("chain link", s.texture(chain_link("chain link", {0.62f, 0.65f, 0.67f}, 6)));
    m.net = masked("hoop net", s.texture(chain_link("net", {0.92f, 0.91f, 0.88f}, 2)));
    m.steel = s.material("galvanised steel", {0.42f, 0.44f, 0.46f}, 0.4f);
    m.iron = s.material("black iron", {0.03f, 0.035f, 0.035f}, 0.5f);
    m.board = s.material("backboard", {0.78f, 0.77f, 0.74f}, 0.5f);
    m.wood = s.material("slats", vec3(0.85f), 0.7f, s.texture(planks("slats", {0.58f, 0.4f, 0.26f}, 1, 123)));
    m.rubber = s.material("ball", {0.62f, 0.22f, 0.06f}, 0.7f);
    m.concrete = s.material("concrete", vec3(0.8f), 0.9f, s.texture(mottled("concrete", {0.72f, 0.71f, 0.68f}, 0.14f, 8, 124)));
    return m;
}

void add_court(Stage& stage, const Materials& m)
{
    MeshBuilder asphalt = stage.builder(m.asphalt, 0.35f), grass = stage.builder(m.grass, 0.2f), paint = stage.builder(m.paint);
    asphalt.patch(16, 14, [](float u, float v) {
        const float x = glm::mix(-9.2f, 9.2f, u), z = glm::mix(-6.2f, 9.5f, v);
        return Vertex{{x, 0, z}, {0, 1, 0}, {x, z}};
    });
    grass.height_field({-60, -60}, {60, 40}, 30, 30, [](float x, float z) {
        const float d = std::max(0.0f, std::max(std::abs(x), std::abs(z)) - 14.0f);
        return -0.04f + 0.06f * d * fractal_noise(vec2(x, z) * 0.05f + 32.0f, 64, 3, 125);
    });
    const auto ring = [&](vec2 centre, float radius, float from, float to) {
        paint.patch(40, 1, [&](float u, float v) {
            const float a = glm::radians(glm::mix(from, to, u)), r = radius + 0.08f * (v - 0.5f);
            return Vertex{{centre.x + r * std::cos(a), 0.004f, centre.y - r * std::sin(a)}, {0, 1, 0}, {u, v}};
        });
    };
    const auto line = [&](vec2 a, vec2 b) {
        const vec2 t = glm::normalize(b - a) * 0.04f;
        paint.quad(
            vec3(a.x - t.x - t.y, 0.004f, a.y - t.y + t.x), vec3(b.x - a.x + 2 * t.x, 0, b.y - a.y + 2 * t.y), vec3(2 * t.y, 0, -2 * t.x));
    };
    line({-7.5f, -5}, {7.5f, -5}), line({-7.5f, -5}, {-7.5f, 9}), line({7.5f, -5}, {7.5f, 9});
    line({-1.8f, -5}, {-1.8f, 0.8f}), line({1.8f, -5}, {1.8f, 0.8f}), line({-1.8f, 0.8f}, {1.8f, 0.8f});
    ring({0, 0.8f}, 1.8f, 180, 360), ring({0, -3.4f}, 6.3f, 194.7f, 345.3f);
    stage.add("asphalt", std::move(asphalt));
    stage.add("grass", std::move(grass));
    stage.add("court lines", std::move(paint));
}

/// One panel of chain link from x = 0 to `panel`, with the post at its start.
void add_chain_fence(Stage& stage, const Materials& m)
{
    MeshBuilder link = stage.builder(m.mesh, 1.0f / 0.48f), frame = stage.builder(m.steel);
    link.patch(6, 6, [](float u, float v) { // slightly slack
        const float slack = 0.03f * std::sin(pi * u) * std::sin(3.0f * pi * v);
        return Vertex{{panel * u, 0.05f + (mesh_height - 0.05f) * v, slack}, {0, 0, 1}, {panel * u, mesh_height * v}};
    });
    frame.cylinder({0, -0.1f, 0}, 0.035f, mesh_height + 0.2f, 10);
    frame.sphere({0, mesh_height + 0.12f, 0}, 0.048f, 10);
    for (float y : {mesh_height, 0.08f, 1.6f})
        frame.tube({{0, y, 0.012f}, {panel, y, 0.012f}}, y > 3.0f ? 0.022f : 0.004f, y > 3.0f ? 0.022f : 0.004f, 7);
    const int link_mesh = stage.mesh("chain link", std::move(link)), frame_mesh = stage.mesh("fence frame", std::move(frame));
    const auto run = [&](vec3 from, float turn, int count, int gap) {
        for (int i = 0; i < count; ++i) {
            const mat4 place = at(from) * turned(turn) * at({panel * float(i), 0, 0});
            if (i != gap) stage.place(link_mesh, place);
            if (i != gap) stage.place(frame_mesh, place);
        }
    };
    run({-9, 0, -6}, 0, 6, -1);
    run({-9, 0, 9}, 90, 5, 1);
    run({9, 0, -6}, -90, 5, -1);
}

void add_hoop(Stage& stage, const Materials& m)
{
    MeshBuilder steel = stage.builder(m.steel), board = stage.builder(m.board), rim = stage.builder(m.rubber),
                net = stage.builder(m.net, 6.0f), iron = stage.builder(m.iron);
    steel.tube({{0, -0.2f, -5.6f}, {0, 2.7f, -5.6f}, {0, 3.1f, -5.45f}, {0, 3.3f, -5.0f}, {0, 3.3f, -4.25f}}, 0.07f, 0.07f, 12);
    steel.tube({{0, 2.4f, -5.6f}, {0, 3.0f, -4.25f}}, 0.03f, 0.03f, 8);
    board.box({0, 3.4f, -4.2f}, {0.9f, 0.55f, 0.025f}, 0.01f);
    for (float x : {-0.3f, 0.3f}) iron.box({x, 3.3f, -4.17f}, {0.025f, 0.23f, 0.008f});
    for (float y : {3.07f, 3.53f}) iron.box({0, y, -4.17f}, {0.325f, 0.025f, 0.008f});
    rim.torus({0, 3.05f, -3.8f}, 0.23f, 0.012f, 28, 8);
    rim.box({0, 3.05f, -4.1f}, {0.06f, 0.02f, 0.08f});
    net.patch(
        20, 4,
        [](float u, float v) {
            const float a = 2.0f * pi * u, r = 0.22f - 0.1f * v + 0.03f * v * v;
            return Vertex{
                {r * std::cos(a), 3.04f - 0.42f * v, -3.8f - r * std::sin(a)}, {std::cos(a), 0.2f, -std::sin(a)}, {1.0f * u, 0.42f * v}};
        },
        true);
    rim.sphere({2.4f, 0.12f, 2.1f}, 0.12f, 20);
    stage.add("hoop post", std::move(steel));
    stage.add("backboard", std::move(board));
    stage.add("backboard marks", std::move(iron));
    stage.add("rim and ball", std::move(rim));
    stage.add("net", std::move(net));
}

void add_bench_and_railings(Stage& stage, const Materials& m)
{
    MeshBuilder iron = stage.builder(m.iron), slats = stage.builder(m.wood, 1.0f), concrete = stage.builder(m.concrete, 0.5f);
    const mat4 base = at({-5.9f, 0, 1.6f}) * turned(70);
    iron.transform = slats.transform = base;
    for (int i = 0; i < 4; ++i) slats.box({0, 0.46f, -0.21f + 0.13f * float(i)}, {0.95f, 0.018f, 0.05f}, 0.008f);
    for (int i = 0; i < 3; ++i) slats.box({0, 0.6f + 0.13f * float(i), -0.31f - 0.035f * float(i)}, {0.95f, 0.05f, 0.016f}, 0.008f);
    for (float x : {-0.75f, 0.75f}) {
        iron.tube({{x, 0, 0.2f}, {x, 0.43f, 0.2f}, {x, 0.43f, -0.24f}, {x, 0.95f, -0.42f}}, 0.022f, 0.022f, 8);
        iron.tube({{x, 0.43f, -0.2f}, {x, 0, -0.32f}}, 0.022f, 0.022f, 8);
        iron.tube({{x, 0.43f, 0.2f}, {x, 0.66f, 0.2f}, {x, 0.68f, -0.3f}}, 0.016f, 0.016f, 8);
    }
    stage.add("bench iron", std::move(iron));
    stage.add("bench slats", std::move(slats));
    MeshBuilder rail = stage.builder(m.iron); // one bay of spear-headed railings, 2 m
    for (int i = 0; i < 14; ++i) {
        const float x = 2.0f * (float(i) + 0.5f) / 14.0f;
        rail.cylinder({x, 0.12f, 0}, 0.009f, 1.1f, 6);
        rail.cone({x, 1.2f, 0}, 0.022f, 0.12f, 6);
    }
    for (float y : {0.22f, 1.08f}) rail.box({1.0f, y, 0}, {1.0f, 0.018f, 0.008f});
    rail.box({0, 0.62f, 0}, {0.025f, 0.62f, 0.025f}, 0.006f);
    rail.sphere({0, 1.29f, 0}, 0.045f, 10);
    const int rail_mesh = stage.mesh("railings", std::move(rail));
    concrete.box({0, 0.06f, 11.0f}, {12.0f, 0.08f, 0.12f}, 0.02f);
    concrete.box({-12, 0.06f, 0}, {0.12f, 0.08f, 11.0f}, 0.02f);
    for (int i = 0; i < 12; ++i) stage.place(rail_mesh, at({-12.0f + 2.0f * float(i), 0.02f, 11.0f}));
    for (int i = 0; i < 11; ++i) stage.place(rail_mesh, at({-12.0f, 0.02f, 11.0f - 2.0f * float(i)}) * turned(90));
    stage.add("plinth", std::move(concrete));
}

/// Poles with sagging wires a few millimetres thick: what a shadow map's texels miss.
void add_wires(Stage& stage, const Materials& m)
{
    MeshBuilder wood = stage.builder(m.wood, 0.6f), wire = stage.builder(m.iron);
    const vec3 feet[] = {{-15, 0, -13}, {-3, 0, -11}, {9.5f, 0, -9.5f}, {22, 0, -8}};
    const vec3 across = glm::normalize(vec3(0.13f, 0, -1));
    for (const vec3& f : feet) {
        wood.tube({f - vec3(0, 0.3f, 0), f + vec3(0, 7.2f, 0)}, 0.14f, 0.1f, 10);
        wood.tube({f + vec3(0, 6.7f, 0) - across, f + vec3(0, 6.7f, 0) + across}, 0.05f, 0.05f, 6);
        for (float s : {-0.85f, -0.3f, 0.3f, 0.85f}) wire.cylinder(f + vec3(0, 6.74f, 0) + s * across, 0.03f, 0.12f, 8);
    }
    for (size_t i = 0; i + 1 < std::size(feet); ++i) {
        for (float s : {-0.85f, -0.3f, 0.3f, 0.85f}) {
            std::vector<vec3> path;
            for (int k = 0; k <= 16; ++k) {
                const float t = float(k) / 16.0f;
                path.push_back(glm::mix(feet[i], feet[i + 1], t) + s * across + vec3(0, 6.86f - (2.0f + 0.5f * s) * t * (1.0f - t), 0));
            }
            wire.tube(path, 0.006f, 0.006f, 4);
        }
    }
    stage.add("poles", std::move(wood));
    stage.add("wires", std::move(wire));
}

} // namespace

Scene fence(double detail)
{
    Stage stage("fence", detail);
    const Materials m = make_materials(stage);
    add_court(stage, m);
    add_chain_fence(stage, m);
    add_hoop(stage, m);
    add_bench_and_railings(stage, m);
    add_wires(stage, m);
    stage.camera("court", {4.6f, 1.9f, 7.2f}, {-0.6f, 1.35f, -2.5f}, 55);
    stage.camera("through the mesh", {-10.4f, 1.5f, 4.4f}, {-2.0f, 0.9f, 0.2f}, 50);
    stage.camera("from above", {8.0f, 8.5f, 10.5f}, {-0.8f, 0, -0.5f}, 50);
    stage.sun("sun", 24, -122, 0.0f, {1.0f, 0.88f, 0.7f});
    stage.sun("soft sun", 24, -122, 0.53f, {1.0f, 0.88f, 0.7f});
    stage.sun("high sun", 62, 40, 0.0f, {1.0f, 0.95f, 0.88f});
    stage.spot("floodlight", {9.5f, 7.5f, -9.0f}, {-1, 0, 1}, 70, 0.15f, {0.95f, 0.97f, 1.0f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
