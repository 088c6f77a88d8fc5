// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/citadel_parts.h"
#include "scene/generators/foliage.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace citadel_parts {

Materials make_materials(Stage& s)
{
    const auto cloth = [&](std::string name, vec3 a, vec3 b, int stripes, uint32_t seed) {
        const int m = s.material(name, vec3(0.9f), 0.95f, s.texture(striped_cloth(name, a, b, stripes, seed)));
        s.edit(m).double_sided = true;
        return m;
    };
    Materials m{};
    m.paving = s.material("paving", vec3(0.8f), 0.85f, s.texture(cobbles("cobbles", {0.7f, 0.64f, 0.56f}, {0.42f, 0.37f, 0.31f}, 12, 91)));
    m.grass = s.material("grass", vec3(0.75f), 0.95f, s.texture(mottled("turf", {0.47f, 0.5f, 0.3f}, 0.4f, 12, 92)));
    m.wall
        = s.material("wall", vec3(0.85f), 0.95f, s.texture(stone_blocks("rubble", {0.76f, 0.68f, 0.57f}, {0.56f, 0.5f, 0.42f}, 4, 8, 93)));
    m.dressed = s.material("dressed stone", vec3(0.85f), 0.85f, s.texture(mottled("dressed", {0.82f, 0.75f, 0.64f}, 0.14f, 8, 94)));
    m.dark_stone = s.material("house stone", vec3(0.8f), 0.95f,
        s.texture(stone_blocks("field stone", {0.62f, 0.57f, 0.52f}, {0.5f, 0.46f, 0.41f}, 4, 7, 95, 0.05f)));
    m.plaster = s.material("plaster", vec3(0.85f), 0.95f, s.texture(mottled("plaster", {0.88f, 0.82f, 0.7f}, 0.12f, 6, 96)));
    m.timber = s.material("timber", vec3(0.7f), 0.8f, s.texture(planks("timber", {0.44f, 0.31f, 0.21f}, 2, 97)));
    m.planks = s.material("planks", vec3(0.85f), 0.75f, s.texture(planks("planks", {0.62f, 0.46f, 0.3f}, 6, 98)));
    m.roof = s.material("roof tiles", vec3(0.85f), 0.8f, s.texture(roof_tiles("roof tiles", {0.64f, 0.38f, 0.28f}, 8, 10, 99)));
    m.slate = s.material("slates", vec3(0.85f), 0.6f, s.texture(roof_tiles("slates", {0.42f, 0.47f, 0.53f}, 8, 12, 100)));
    m.iron = s.material("iron", {0.1f, 0.1f, 0.105f}, 0.5f);
    m.rope = s.material("rope", {0.5f, 0.4f, 0.25f}, 0.95f);
    m.hay = s.material("hay", vec3(0.85f), 0.95f, s.texture(mottled("hay", {0.82f, 0.68f, 0.36f}, 0.4f, 24, 101)));
    m.sack = s.material("sacking", {0.5f, 0.41f, 0.28f}, 0.95f);
    m.dark = s.material("dark interior", {0.012f, 0.011f, 0.01f}, 0.95f);
    m.red_cloth = cloth("red stripes", {0.72f, 0.16f, 0.13f}, {0.93f, 0.88f, 0.76f}, 4, 102);
    m.blue_cloth = cloth("blue stripes", {0.2f, 0.34f, 0.58f}, {0.93f, 0.9f, 0.82f}, 4, 103);
    m.green_cloth = cloth("green stripes", {0.28f, 0.46f, 0.26f}, {0.94f, 0.84f, 0.55f}, 4, 104);
    m.tent_cloth = cloth("tent stripes", {0.92f, 0.87f, 0.75f}, {0.62f, 0.22f, 0.18f}, 3, 105);
    m.leaves = s.material("leaves", {0.13f, 0.2f, 0.05f}, 0.7f);
    s.edit(m.leaves).double_sided = true;
    m.bark = s.material("bark", {0.16f, 0.11f, 0.075f}, 0.95f);
    m.fruit_red = s.material("apples", {0.5f, 0.05f, 0.03f}, 0.4f);
    m.fruit_green = s.material("pears", {0.5f, 0.45f, 0.08f}, 0.45f);
    m.clay = s.material("clay", {0.45f, 0.2f, 0.1f}, 0.6f);
    return m;
}

void add_ground(Stage& stage, const Materials& m)
{
    MeshBuilder paving = stage.builder(m.paving, 0.3f);
    const auto height = [](float x, float z) {
        const float worn = 0.1f * std::exp(-0.06f * x * x) * std::exp(-0.004f * (z + 4.0f) * (z + 4.0f)); // the way from the gate
        return 0.09f * (fractal_noise(vec2(x, z) * 0.45f + 64.0f, 256, 3, 111) - 0.5f) - worn + 0.03f;
    };
    paving.height_field({-half_width - 1.0f, -half_depth - 3.5f}, {half_width + 1.0f, half_depth + 1.0f}, 40, 36, height);
    stage.add("paving", std::move(paving));
    MeshBuilder grass = stage.builder(m.grass, 0.12f);
    grass.height_field({-150, -150}, {150, 150}, 26, 26, [](float x, float z) {
        const float d = std::max(0.0f, std::max(std::abs(x) - half_width, std::abs(z) - half_depth) - 8.0f);
        return -0.12f + d * (0.05f * (fractal_noise(vec2(x, z) * 0.02f + 16.0f, 64, 3, 112) - 0.42f)) - 0.0006f * d * d;
    });
    stage.add("grass", std::move(grass));
}

void add_greenery(Stage& stage, const Materials& m)
{
    const TreeShape shape{
        .seed = 5, .trunk = 3.0f, .radius = 0.24f, .levels = 2, .branches = 6, .spread = 60, .reach = 0.74f, .lift = 0.3f};
    MeshBuilder wood = stage.builder(m.bark), leaves = stage.builder(m.leaves);
    const int per_twig = std::max(1, int(std::lround(38.0f * stage.fineness() * stage.fineness())));
    const auto twigs = grow_tree(wood, shape, per_twig);
    Random random(113);
    for (const Twig& t : twigs) add_leaf(leaves, t, 0.45f / stage.fineness(), {0, 3.4f, 0}, random);
    const int wood_mesh = stage.mesh("tree", std::move(wood)), leaf_mesh = stage.mesh("leaves", std::move(leaves));
    const mat4 places[] = {at({-4.6f, 0, -7.4f}), at({13.2f, 0, 10.6f}) * turned(140) * scaled(vec3(1.15f)),
        at({24.5f, 0, -20.5f}) * turned(60) * scaled(vec3(1.3f))};
    for (const mat4& p : places) stage.place(wood_mesh, p), stage.place(leaf_mesh, p);
    MeshBuilder kerb = stage.builder(m.dressed, 0.5f), soil = stage.builder(m.grass, 0.5f);
    for (vec3 c : {vec3(-4.6f, 0, -7.4f), vec3(13.2f, 0, 10.6f)}) {
        for (int i = 0; i < 12; ++i) {
            kerb.transform = at(c) * turned(30.0f * float(i)) * at({0, 0.14f, 1.15f});
            kerb.box(vec3(0), {0.29f, 0.17f, 0.14f}, 0.04f);
        }
        soil.cylinder(c, 1.1f, 0.2f, 16);
    }
    stage.add("kerbs", std::move(kerb));
    stage.add("soil", std::move(soil));
}

void add_banner(MeshBuilder& b, float width, float height, float wave)
{
    b.patch(8, 10, [&](float u, float v) {
        const float tail = 0.22f * width * (1.0f - 2.0f * std::abs(u - 0.5f));
        const float z = wave * v * std::sin(5.0f * v + 2.2f * u), slope = wave * std::cos(5.0f * v + 2.2f * u);
        return Vertex{{width * (u - 0.5f), -v * (height - tail), z + 0.02f}, glm::normalize(vec3(-1.5f * slope * v, 2.0f * slope * v, 1)),
            vec2(u, v * height / width)};
    });
}

void add_cloth(Stage& stage, const Materials& m)
{
    MeshBuilder red = stage.builder(m.red_cloth, 0.5f), blue = stage.builder(m.blue_cloth, 0.5f), wood = stage.builder(m.timber),
                rope = stage.builder(m.rope);
    const auto hang = [&](MeshBuilder& b, const mat4& place, float w, float h) {
        b.transform = wood.transform = place;
        add_banner(b, w, h, 0.09f);
        wood.tube({{-0.5f * w - 0.12f, 0.02f, 0.03f}, {0.5f * w + 0.12f, 0.02f, 0.03f}}, 0.035f, 0.035f, 6);
    };
    for (float s : {-1.0f, 1.0f}) hang(red, at({s * 2.15f, 7.4f, -half_depth + 0.78f}), 0.9f, 2.6f);
    for (float x : {-2.0f, 2.0f}) hang(blue, at({-9.6f + x, 13.0f, -4.9f}), 1.1f, 3.4f);
    for (float z : {-6.0f, 0.0f}) hang(z < -3.0f ? red : blue, at({half_width - 0.05f, 5.5f, z}) * turned(-90), 1.2f, 3.0f);
    const auto flag = [&](MeshBuilder& b, vec3 top, float size) {
        b.transform = at(top) * turned(-35);
        b.patch(10, 4, [&](float u, float v) {
            const float w = 0.12f * size * std::sin(7.0f * u - v);
            return Vertex{{size * u, -0.6f * size * v * (1.0f - 0.5f * u) - 0.15f * size * u, w * u},
                glm::normalize(vec3(-0.8f * std::cos(7.0f * u - v) * u, 0, 1)), vec2(u, v)};
        });
    };
    for (float x : {-1.0f, 1.0f})
        for (float z : {-1.0f, 1.0f}) flag(x * z > 0.0f ? red : blue, {x * (half_width + 0.9f), 19.4f, z * (half_depth + 0.9f)}, 1.6f);
    flag(red, {-9.6f, 22.1f, -9.2f}, 2.4f);
    // Pennants on lines across the court.
    const vec3 lines[][2]
        = {{{-11.0f, 4.9f, 3.4f}, {half_width - 0.1f, 5.6f, 2.0f}}, {{-5.5f, 7.2f, -5.0f}, {half_width - 0.1f, 5.6f, 2.0f}}};
    for (const auto& line : lines) {
        std::vector<vec3> path;
        const int count = 26;
        for (int i = 0; i <= count; ++i) {
            const float t = float(i) / float(count);
            path.push_back(glm::mix(line[0], line[1], t) - vec3(0, 5.0f * t * (1.0f - t), 0));
        }
        rope.tube(path, 0.012f, 0.012f, 4);
        red.transform = blue.transform = mat4(1);
        for (int i = 0; i < count; ++i) {
            const vec3 a = glm::mix(path[size_t(i)], path[size_t(i) + 1], 0.15f), c = glm::mix(path[size_t(i)], path[size_t(i) + 1], 0.85f);
            (i & 1 ? red : blue).flat_triangle(a, 0.5f * (a + c) + vec3(0.04f, -0.5f, 0.05f), c);
        }
    }
    stage.add("red banners", std::move(red));
    stage.add("blue banners", std::move(blue));
    stage.add("banner rods", std::move(wood));
    stage.add("pennant lines", std::move(rope));
}

} // namespace citadel_parts

Scene citadel(double detail)
{
    using namespace citadel_parts;
    Stage stage("citadel", detail);
    const Materials m = make_materials(stage);
    add_ground(stage, m);
    add_curtain_walls(stage, m);
    add_towers(stage, m);
    add_gate(stage, m);
    add_keep(stage, m);
    add_stairs(stage, m);
    add_houses(stage, m);
    add_market(stage, m);
    add_greenery(stage, m);
    add_cloth(stage, m);
    stage.camera("courtyard", {5.2f, 3.0f, 12.6f}, {-1.0f, 3.1f, -4.0f}, 60);
    stage.camera("bird's eye", {8.0f, 25.0f, 35.0f}, {-1.0f, 1.0f, -1.5f}, 45);
    stage.camera("market", {1.6f, 1.6f, 3.6f}, {6.6f, 1.3f, -1.2f}, 55);
    stage.sun("sun", 38, 64, 0.0f, {1.0f, 0.9f, 0.74f});
    stage.sun("soft sun", 38, 64, 0.53f, {1.0f, 0.9f, 0.74f});
    stage.sun("evening sun", 14, -58, 0.53f, {1.0f, 0.68f, 0.4f});
    stage.point("lantern", {2.4f, 2.4f, -1.0f}, 0.12f, {1.0f, 0.66f, 0.32f});
    stage.spot("watch light", {half_width, 9.5f, half_depth}, {-2.0f, 0, 0}, 55, 0.2f, {1.0f, 0.85f, 0.6f});
    stage.rect("great hall window", {-5.2f, 8.2f, -9.2f}, {0, 0, -1.5f}, {0, 0.9f, 0}, {1.0f, 0.75f, 0.45f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
