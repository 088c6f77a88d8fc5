// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/citadel_parts.h"
#include "scene/generators/foliage.h"

namespace gnomon::scene::generators::citadel_parts {

namespace {

void add_crate(MeshBuilder& b, float s)
{
    const float h = 0.5f * s, board = 0.018f;
    b.box({0, h, 0}, {h - 2.0f * board, h - board, h - 2.0f * board});
    for (float x : {-1.0f, 1.0f}) {
        for (float z : {-1.0f, 1.0f}) b.box({x * (h - 0.05f), h, z * (h - 0.05f)}, {0.05f, h, 0.05f});
        for (float y : {0.06f, s - 0.06f}) {
            b.box({0, y, x * (h - board)}, {h - 0.08f, 0.05f, board});
            b.box({x * (h - board), y, 0}, {board, 0.05f, h - 0.08f});
        }
    }
}

void add_barrel(MeshBuilder& wood, MeshBuilder& iron)
{
    wood.lathe({{0, 0.03f}, {0.26f, 0.03f}, {0.27f, 0}, {0.3f, 0}, {0.36f, 0.24f}, {0.385f, 0.45f}, {0.36f, 0.66f}, {0.3f, 0.9f},
                   {0.27f, 0.9f}, {0.26f, 0.85f}, {0, 0.85f}},
        16);
    for (float y : {0.12f, 0.32f, 0.72f}) {
        const float r = 0.392f - 0.42f * (y - 0.45f) * (y - 0.45f);
        iron.lathe({{r - 0.06f, y - 0.03f}, {r, y - 0.03f}, {r, y + 0.03f}, {r - 0.06f, y + 0.03f}, {r - 0.06f, y - 0.03f}}, 14);
    }
}

/// A stall: four posts, a counter and a cloth that sags between its poles (a sheet).
void add_stall(MeshBuilder& wood, MeshBuilder& cloth)
{
    constexpr float w = 1.6f, d = 1.1f;
    for (float x : {-w, w}) {
        wood.box({x, 1.35f, -d}, {0.05f, 1.35f, 0.05f});
        wood.box({x, 1.1f, d}, {0.05f, 1.1f, 0.05f});
    }
    wood.box({0, 2.68f, -d}, {w + 0.15f, 0.04f, 0.04f}, 0.01f);
    wood.box({0, 2.18f, d}, {w + 0.15f, 0.04f, 0.04f}, 0.01f);
    wood.box({0, 0.88f, 0.55f}, {w - 0.1f, 0.035f, 0.45f}, 0.012f);
    for (int i = 0; i < 8; ++i) wood.box({-w + 0.3f + 0.4f * float(i), 0.45f, 0.9f}, {0.18f, 0.4f, 0.02f});
    wood.box({0, 1.6f, -d + 0.15f}, {w - 0.1f, 0.025f, 0.2f}, 0.008f);
    const auto surface = [](float u, float v) {
        const float x = (2.0f * u - 1.0f) * (w + 0.2f), z = glm::mix(-d - 0.1f, d + 0.1f, v);
        const float sag = 0.16f * std::sin(pi * v) * (0.6f + 0.4f * std::abs(std::cos(1.5f * pi * u)));
        return vec3(x, glm::mix(2.74f, 2.24f, v) - sag, z);
    };
    cloth.patch(18, 10, [&](float u, float v) {
        const float e = 0.01f;
        const vec3 n = glm::normalize(glm::cross(surface(u, v + e) - surface(u, v - e), surface(u + e, v) - surface(u - e, v)));
        return Vertex{surface(u, v), n, vec2(u * 3.0f, v * 2.0f)};
    });
    cloth.patch(36, 2, [&](float u, float v) { // the valance, scalloped
        const vec3 top = surface(u, 1.0f);
        const float drop = 0.2f + 0.1f * std::abs(std::sin(9.0f * pi * u));
        return Vertex{top + vec3(0, -drop * v, 0.04f * std::sin(18.0f * pi * u) * v), {0, 0.1f, 1}, vec2(u * 3.0f, 2.0f + 0.4f * v)};
    });
}

void add_stalls(Stage& stage, const Materials& m)
{
    const int cloths[] = {m.red_cloth, m.green_cloth, m.blue_cloth};
    const mat4 places[] = {at({5.6f, 0, -2.6f}) * turned(-38), at({8.9f, 0, 1.3f}) * turned(-72), at({8.6f, 0, 5.9f}) * turned(-100)};
    MeshBuilder wood = stage.builder(m.timber, 0.9f), red = stage.builder(m.fruit_red), green = stage.builder(m.fruit_green),
                clay = stage.builder(m.clay);
    Random random(84);
    for (int k = 0; k < 3; ++k) {
        MeshBuilder cloth = stage.builder(cloths[k], 0.7f);
        wood.transform = cloth.transform = places[k];
        add_stall(wood, cloth);
        stage.add("stall cloth", std::move(cloth));
        for (int tray = 0; tray < 3; ++tray) {
            const float x = -1.0f + 1.0f * float(tray);
            wood.transform = places[k] * at({x, 0.96f, 0.55f}) * turned(12, vec3(1, 0, 0));
            wood.box({0, 0, 0}, {0.4f, 0.015f, 0.3f});
            for (float s : {-1.0f, 1.0f})
                wood.box({s * 0.4f, 0.05f, 0}, {0.012f, 0.05f, 0.3f}), wood.box({0, 0.05f, s * 0.3f}, {0.4f, 0.05f, 0.012f});
            MeshBuilder& fruit = (tray + k) % 2 ? red : green;
            fruit.transform = wood.transform;
            if (k == 1 && tray == 1) continue;
            for (int i = 0; i < 14; ++i) {
                const vec3 p(-0.3f + 0.15f * float(i % 5) + 0.02f * random.next(), 0.075f + (i > 10 ? 0.09f : 0.0f),
                    -0.19f + 0.16f * float((i / 5) % 3) + 0.02f * random.next());
                fruit.sphere(p, 0.062f + 0.01f * random.next(), 6);
            }
        }
    }
    for (int i = 0; i < 5; ++i) {
        clay.transform = places[1] * at({-1.2f + 0.6f * float(i), i % 2 ? 0.92f : 1.62f, i % 2 ? 0.5f : -0.95f})
            * scaled(vec3(0.75f + 0.3f * random.next()));
        clay.lathe(
            {{0, 0}, {0.08f, 0}, {0.16f, 0.12f}, {0.15f, 0.22f}, {0.07f, 0.3f}, {0.1f, 0.35f}, {0.08f, 0.35f}, {0.05f, 0.3f}, {0, 0.29f}},
            14);
    }
    stage.add("stalls", std::move(wood));
    stage.add("red fruit", std::move(red));
    stage.add("green fruit", std::move(green));
    stage.add("pots", std::move(clay));
}

void add_well(Stage& stage, const Materials& m)
{
    const mat4 base = at({-1.8f, 0, 1.6f});
    MeshBuilder stone = stage.builder(m.dressed, 0.5f), wood = stage.builder(m.timber, 0.9f), roof = stage.builder(m.roof, 0.5f),
                rope = stage.builder(m.rope), dark = stage.builder(m.dark);
    for (int course = 0; course < 3; ++course) {
        for (int i = 0; i < 14; ++i) {
            stone.tint = vec3(0.8f + 0.2f * hash01(uint32_t(i), uint32_t(course), 85));
            stone.transform
                = base * turned(360.0f * (float(i) + 0.5f * float(course & 1)) / 14.0f) * at({0, 0.17f + 0.29f * float(course), 1.0f});
            stone.box(vec3(0), {0.225f, 0.14f, 0.17f}, 0.035f);
        }
    }
    stone.transform = base;
    stone.cylinder({0, 0, 0}, 1.55f, 0.07f, 24, 0.03f);
    dark.transform = base;
    dark.cylinder({0, 0.02f, 0}, 0.86f, 0.4f, 20);
    wood.transform = base;
    for (float x : {-1.0f, 1.0f}) wood.box({x, 1.5f, 0}, {0.08f, 1.1f, 0.08f}, 0.02f);
    wood.transform = base * at({-1.15f, 1.75f, 0}) * turned(-90, vec3(0, 0, 1));
    wood.cylinder(vec3(0), 0.09f, 2.35f, 10);
    wood.transform = base;
    wood.tube({{1.2f, 1.75f, 0}, {1.28f, 1.75f, 0}, {1.28f, 1.45f, 0.1f}, {1.5f, 1.45f, 0.1f}}, 0.025f, 0.025f, 6);
    wood.transform = base * at({0.1f, 0.92f, 0});
    wood.lathe({{0, 0}, {0.13f, 0}, {0.17f, 0.3f}, {0.145f, 0.3f}, {0.115f, 0.03f}, {0, 0.03f}}, 12);
    rope.transform = base;
    rope.tube({{0.1f, 1.7f, 0.09f}, {0.1f, 1.35f, 0.02f}, {0.1f, 1.2f, 0}}, 0.014f, 0.014f, 5);
    for (int i = 0; i < 5; ++i) {
        rope.transform = base * at({-0.1f + 0.06f * float(i), 1.75f, 0}) * turned(90, vec3(0, 0, 1));
        rope.torus(vec3(0), 0.1f, 0.022f, 10, 5);
    }
    roof.transform = base * at({0, 2.5f, 0});
    add_gable_roof(roof, 2.8f, 2.2f, 0.9f, 0.08f);
    stage.add("well", std::move(stone));
    stage.add("well wood", std::move(wood));
    stage.add("well roof", std::move(roof));
    stage.add("rope", std::move(rope));
    stage.add("well shaft", std::move(dark));
}

void add_cart(Stage& stage, const Materials& m)
{
    const mat4 base = at({2.2f, 0, 6.4f}) * turned(62);
    MeshBuilder wood = stage.builder(m.planks, 0.8f), iron = stage.builder(m.iron), sack = stage.builder(m.sack, 1.5f);
    wood.transform = base * at({0, 0.85f, 0}) * turned(-6, vec3(0, 0, 1));
    wood.box({0, 0, 0}, {1.35f, 0.04f, 0.65f}, 0.01f);
    for (float z : {-0.65f, 0.65f}) {
        wood.box({0, 0.42f, z}, {1.35f, 0.05f, 0.025f}, 0.01f);
        wood.box({0, 0.2f, z}, {1.35f, 0.07f, 0.02f}, 0.008f);
        for (float x : {-1.25f, -0.4f, 0.4f, 1.25f}) wood.box({x, 0.25f, z}, {0.04f, 0.28f, 0.035f});
        wood.tube({{1.2f, -0.08f, 0.7f * z}, {2.0f, -0.12f, 0.62f * z}, {3.1f, -0.42f, 0.6f * z}}, 0.055f, 0.035f, 8);
    }
    wood.box({-1.36f, 0.25f, 0}, {0.02f, 0.25f, 0.62f}, 0.008f);
    for (float z : {-0.82f, 0.82f}) {
        const mat4 hub = base * at({-0.1f, 0.62f, z}) * turned(90, vec3(1, 0, 0));
        wood.transform = iron.transform = hub;
        wood.torus(vec3(0), 0.55f, 0.05f, 28, 6);
        wood.cylinder({0, -0.13f, 0}, 0.11f, 0.26f, 12, 0.02f);
        iron.lathe({{0.56f, -0.05f}, {0.62f, -0.05f}, {0.62f, 0.05f}, {0.56f, 0.05f}, {0.56f, -0.05f}}, 28);
        for (int i = 0; i < 10; ++i) {
            const float a = 0.2f * pi * float(i);
            wood.tube({{0.08f * std::cos(a), 0, 0.08f * std::sin(a)}, {0.53f * std::cos(a), 0, 0.53f * std::sin(a)}}, 0.028f, 0.024f, 6);
        }
    }
    wood.transform = base * at({-0.1f, 0.62f, -0.85f}) * turned(90, vec3(1, 0, 0));
    wood.cylinder(vec3(0), 0.05f, 1.7f, 8);
    Random random(86);
    for (int i = 0; i < 7; ++i) {
        const bool beside = i > 4;
        sack.transform = (beside ? at({3.3f + 0.5f * float(i - 5), 0, 4.6f + 0.3f * float(i - 5)})
                                 : base * at({-0.9f + 0.45f * float(i), 0.85f + 0.03f * float(i), 0.25f - 0.4f * float(i & 1)}))
            * turned(360.0f * random.next()) * scaled({1, 0.85f + 0.3f * random.next(), 0.8f});
        sack.lathe(
            {{0, 0}, {0.2f, 0}, {0.29f, 0.1f}, {0.3f, 0.28f}, {0.2f, 0.46f}, {0.07f, 0.52f}, {0.06f, 0.55f}, {0.13f, 0.64f}, {0, 0.6f}},
            14);
    }
    stage.add("cart", std::move(wood));
    stage.add("cart iron", std::move(iron));
    stage.add("sacks", std::move(sack));
}

void add_tents(Stage& stage, const Materials& m)
{
    MeshBuilder cloth = stage.builder(m.tent_cloth), wood = stage.builder(m.timber), rope = stage.builder(m.rope);
    for (int k = 0; k < 2; ++k) {
        const mat4 base = at(k == 0 ? vec3(-7.4f, 0, 4.6f) : vec3(-9.0f, 0, 9.8f)) * turned(k == 0 ? 125.0f : 100.0f)
            * scaled(vec3(k == 0 ? 1.0f : 0.85f));
        cloth.transform = wood.transform = rope.transform = base;
        // A wall below and a cone above, open by a slit at the front; the edge is scalloped between twelve guys.
        const auto at_angle = [](float u, float r, float y) {
            const float a = glm::mix(0.16f, 2.0f * pi - 0.16f, u) + 0.5f * pi;
            const float fold = 1.0f - 0.035f * std::abs(std::sin(6.0f * a));
            return vec3(r * fold * std::cos(a), y, -r * fold * std::sin(a));
        };
        cloth.patch(48, 2, [&](float u, float v) {
            const vec3 p = at_angle(u, 2.0f + 0.15f * (1.0f - v), 1.9f * v);
            return Vertex{p, glm::normalize(vec3(p.x, 0.15f, p.z)), vec2(4.0f * u, v)};
        });
        cloth.patch(48, 5, [&](float u, float v) {
            const float r = glm::mix(2.35f, 0.05f, v), y = 1.8f + 2.2f * v + 0.35f * v * v * v - 0.15f * std::sin(pi * v);
            const vec3 p = at_angle(u, r, y);
            return Vertex{p, glm::normalize(vec3(p.x, 0.9f * std::max(r, 0.1f), p.z)), vec2(4.0f * u, 1.0f + v)};
        });
        wood.cylinder(vec3(0), 0.05f, 4.9f, 8);
        for (int i = 0; i < 10; ++i) {
            const float a = 0.2f * pi * (float(i) + 0.5f);
            const vec3 d(std::cos(a), 0, std::sin(a));
            rope.tube({d * 2.3f + vec3(0, 1.8f, 0), d * 3.1f}, 0.012f, 0.012f, 4);
            wood.tube({d * 3.05f + vec3(0, 0.25f, 0), d * 3.15f + vec3(0, -0.1f, 0)}, 0.025f, 0.02f, 5);
        }
    }
    stage.add("tents", std::move(cloth));
    stage.add("tent poles", std::move(wood));
    stage.add("guys", std::move(rope));
}

void add_goods(Stage& stage, const Materials& m)
{
    MeshBuilder crate = stage.builder(m.planks, 1.2f), barrel = stage.builder(m.planks, 1.0f), hoops = stage.builder(m.iron);
    add_crate(crate, 0.8f);
    add_barrel(barrel, hoops);
    const int crate_mesh = stage.mesh("crate", std::move(crate)), barrel_mesh = stage.mesh("barrel", std::move(barrel)),
              hoops_mesh = stage.mesh("barrel hoops", std::move(hoops));
    struct Spot {
        float x, z, turn, y;
    };
    const Spot crates[] = {{4.0f, -9.6f, 10, 0}, {4.9f, -9.9f, -6, 0}, {4.3f, -9.7f, 30, 0.8f}, {-7.4f, -3.4f, 20, 0}, {10.8f, 3.6f, 5, 0},
        {11.0f, 4.5f, -12, 0}, {10.9f, 3.9f, 25, 0.8f}, {-10.4f, 0.2f, 8, 0}, {3.4f, 0.4f, 42, 0}};
    for (const Spot& s : crates) stage.place(crate_mesh, at({s.x, s.y, s.z}) * turned(s.turn));
    const Spot barrels[] = {{-6.4f, -4.3f, 0, 0}, {-5.6f, -4.6f, 30, 0}, {-6.0f, -3.7f, 60, 0}, {4.1f, 1.0f, 10, 0}, {4.6f, 0.3f, 80, 0},
        {12.4f, -7.9f, 0, 0}, {13.2f, -8.1f, 40, 0}, {-10.5f, -0.9f, 0, 0}, {11.5f, -1.3f, 20, 0}};
    for (const Spot& s : barrels)
        for (int part : {barrel_mesh, hoops_mesh}) stage.place(part, at({s.x, s.y, s.z}) * turned(s.turn));
    for (int part : {barrel_mesh, hoops_mesh}) stage.place(part, at({5.3f, 0.385f, 1.6f}) * turned(25) * turned(90, vec3(0, 0, 1)));
}

} // namespace

void add_market(Stage& stage, const Materials& m)
{
    add_stalls(stage, m);
    add_well(stage, m);
    add_cart(stage, m);
    add_tents(stage, m);
    add_goods(stage, m);
}

} // namespace gnomon::scene::generators::citadel_parts
