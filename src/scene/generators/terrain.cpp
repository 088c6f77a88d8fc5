// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/citadel_parts.h"
#include "scene/generators/foliage.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

/// Height of the land: gentle near the origin, where the huts stand, mountainous beyond a kilometre.
float land(float x, float z)
{
    const vec2 p(x, z);
    const float r = glm::length(p);
    const float knolls = 7.0f * (fractal_noise(p * 0.016f + 100.0f, 4096, 4, 131) - 0.5f);
    const float calm = glm::smoothstep(8.0f, 60.0f, glm::length(p - vec2(-2.0f, -14.0f)));
    const float hills = 70.0f * (fractal_noise(p * 0.0035f + 50.0f, 4096, 5, 132) - 0.4f) * glm::smoothstep(90.0f, 500.0f, r);
    const float n = fractal_noise(p * 0.0011f + 30.0f, 4096, 6, 133);
    const float ridge = 1.0f - std::abs(2.0f * n - 1.0f);
    const float mountains = 620.0f * ridge * ridge * ridge * glm::smoothstep(500.0f, 2200.0f, r);
    const float bumps = 0.25f * (fractal_noise(p * 0.35f + 500.0f, 4096, 3, 134) - 0.5f);
    return knolls * (0.25f + 0.75f * calm) + hills + mountains + bumps;
}

vec3 land_color(vec3 p, vec3 n)
{
    const float patches = fractal_noise(vec2(p.x, p.z) * 0.03f + 9.0f, 4096, 3, 135);
    vec3 c = glm::mix(vec3(0.62f, 0.68f, 0.36f), vec3(0.86f, 0.78f, 0.48f), glm::smoothstep(0.42f, 0.62f, patches));
    c = glm::mix(c, vec3(0.34f, 0.45f, 0.3f),
        glm::smoothstep(0.5f, 0.58f, fractal_noise(vec2(p.x, p.z) * 0.006f, 4096, 4, 136))
            * glm::smoothstep(150.0f, 350.0f, glm::length(p)));
    c = glm::mix(c, vec3(0.66f, 0.62f, 0.58f), glm::smoothstep(0.93f, 0.8f, n.y)); // bare rock where it is steep
    return glm::mix(c, vec3(1.0f), glm::smoothstep(330.0f, 420.0f, p.y) * glm::smoothstep(0.6f, 0.8f, n.y)); // snow
}

/// A polar grid about the origin whose rings widen with distance: near detail and far hills without seams.
void add_land(Stage& stage, int material)
{
    MeshBuilder b = stage.builder(material, 0.12f);
    // The vertex colour depends on the vertex; patch calls the surface before it adds the vertex.
    b.patch(
        132, 100,
        [&](float u, float v) {
            const float a = 2.0f * pi * u, r = v <= 0.0f ? 0.0f : 130.0f * v + 3400.0f * std::pow(v, 5.0f);
            const float x = r * std::cos(a), z = -r * std::sin(a), step = 0.3f + 0.006f * r;
            const vec3 n = glm::normalize(vec3(land(x - step, z) - land(x + step, z), 2.0f * step, land(x, z - step) - land(x, z + step)));
            const vec3 p(x, land(x, z), z);
            b.tint = land_color(p, n);
            return Vertex{p, n, {x, z}};
        },
        true);
    stage.add("land", std::move(b));
}

mat4 on_land(float x, float z, float sink = 0.0f) { return at({x, land(x, z) - sink, z}); }

std::vector<int> add_hut(Stage& stage, int stone, int wood, int thatch, int dark)
{
    MeshBuilder walls = stage.builder(stone, 0.4f), timber = stage.builder(wood, 0.8f), roof = stage.builder(thatch, 0.4f),
                door = stage.builder(dark);
    walls.box({0, 0.7f, 0}, {2.4f, 1.7f, 1.7f}, 0.12f);
    for (float s : {-1.0f, 1.0f}) {
        walls.transform = at({s * 2.25f, 0, 0}) * turned(90);
        walls.extrude({{-1.65f, 2.3f}, {1.65f, 2.3f}, {0, 4.0f}}, 0.25f);
    }
    walls.transform = at({1.5f, 0, -0.5f});
    walls.box({0, 3.4f, 0}, {0.35f, 1.4f, 0.35f}, 0.06f);
    roof.transform = at({0, 2.2f, 0});
    citadel_parts::add_gable_roof(roof, 5.5f, 4.3f, 2.0f, 0.28f);
    timber.box({-0.5f, 0.95f, 1.7f}, {0.42f, 0.95f, 0.06f}, 0.02f);
    for (float x : {-1.0f, 0.0f}) timber.box({x, 1.0f, 1.72f}, {0.08f, 1.0f, 0.1f}, 0.02f);
    timber.box({-0.5f, 2.05f, 1.72f}, {0.65f, 0.09f, 0.1f}, 0.02f);
    timber.box({1.2f, 1.02f, 1.75f}, {0.45f, 0.05f, 0.12f}, 0.015f);
    door.box({1.2f, 1.4f, 1.7f}, {0.35f, 0.33f, 0.03f});
    timber.box({1.2f, 1.4f, 1.72f}, {0.025f, 0.33f, 0.03f});
    return {stage.mesh("hut walls", std::move(walls)), stage.mesh("hut timber", std::move(timber)), stage.mesh("hut roof", std::move(roof)),
        stage.mesh("hut window", std::move(door))};
}

/// A rail fence beside a path, post by post over the ground.
void add_rails(Stage& stage, int wood)
{
    MeshBuilder b = stage.builder(wood, 0.8f);
    vec3 before(0);
    for (int i = 0; i < 22; ++i) {
        const float t = float(i) / 21.0f;
        const float x = glm::mix(-3.6f, -11.0f, t) + 2.2f * std::sin(2.6f * t), z = glm::mix(7.0f, -30.0f, t);
        const vec3 foot(x, land(x, z), z);
        b.transform = at(foot) * turned(9.0f * std::sin(5.0f * float(i))) * turned(4.0f * std::sin(3.0f * float(i)), vec3(0, 0, 1));
        b.box({0, 0.5f, 0}, {0.06f, 0.65f, 0.06f}, 0.02f);
        b.transform = mat4(1);
        if (i > 0 && i != 8)
            for (float y : {0.5f, 0.95f}) b.tube({before + vec3(0, y, 0), foot + vec3(0, y + 0.03f, 0)}, 0.04f, 0.035f, 6);
        before = foot;
    }
    stage.add("rail fence", std::move(b));
}

void add_poles(Stage& stage, int wood, int wire_material)
{
    MeshBuilder b = stage.builder(wood, 0.5f), wire = stage.builder(wire_material);
    std::vector<vec3> tops;
    for (int i = 0; i < 9; ++i) {
        const float x = 9.0f - 2.2f * float(i), z = 6.0f - 24.0f * float(i);
        const vec3 foot(x, land(x, z), z);
        b.tube({foot - vec3(0, 0.4f, 0), foot + vec3(0, 7.0f, 0)}, 0.14f, 0.1f, 8);
        b.box(foot + vec3(0, 6.5f, 0), {0.9f, 0.06f, 0.06f}, 0.015f);
        tops.push_back(foot + vec3(0, 6.6f, 0));
    }
    for (size_t i = 0; i + 1 < tops.size(); ++i) {
        for (float s : {-0.8f, 0.8f}) {
            std::vector<vec3> path;
            for (int k = 0; k <= 12; ++k) {
                const float t = float(k) / 12.0f;
                path.push_back(glm::mix(tops[i], tops[i + 1], t) + vec3(s, -3.2f * t * (1.0f - t), 0));
            }
            wire.tube(path, 0.012f, 0.012f, 4);
        }
    }
    stage.add("poles", std::move(b));
    stage.add("wires", std::move(wire));
}

void scatter(Stage& stage, int rock_material, int tuft_material, int bark, int needles)
{
    Random random(137);
    int rocks[3];
    for (uint32_t i = 0; i < 3; ++i) {
        MeshBuilder b = stage.builder(rock_material, 0.5f);
        add_rock(b, {0.8f, 0.6f, 0.65f}, 16, 140 + i);
        rocks[i] = stage.mesh("rock", std::move(b));
    }
    for (int i = 0; i < 26; ++i) {
        const float r = 3.0f + 60.0f * random.next() * random.next(), a = 2.0f * pi * random.next();
        const float x = r * std::cos(a), z = r * std::sin(a) - 6.0f;
        stage.place(rocks[i % 3],
            on_land(x, z, 0.15f) * turned(360.0f * random.next()) * scaled(vec3(0.35f + 1.1f * random.next() * random.next())));
    }
    MeshBuilder tufts = stage.builder(tuft_material);
    add_grass(tufts, std::max(1, int(std::lround(26.0f * stage.fineness() * stage.fineness()))), 0.8f, 0.36f, random);
    const int tuft_mesh = stage.mesh("tufts", std::move(tufts));
    for (int i = 0; i < 70; ++i) {
        const float x = random.between(-14, 14), z = random.between(-24, 9);
        stage.place(tuft_mesh, on_land(x, z) * turned(360.0f * random.next()));
    }
    // Firs: drooping tiers. Seen from afar they are cones; near ones show the ragged rim.
    MeshBuilder fir = stage.builder(needles), trunk = stage.builder(bark);
    trunk.tube({{0, -0.5f, 0}, {0, 3.0f, 0}}, 0.24f, 0.14f, 7);
    for (int tier = 0; tier < 6; ++tier) {
        const float y = 1.3f + 1.25f * float(tier), r = 2.1f - 0.32f * float(tier);
        fir.tint = vec3(0.8f + 0.05f * float(tier));
        fir.patch(
            18, 2,
            [&](float u, float v) {
                const float a = 2.0f * pi * u + float(tier), rag = 1.0f - 0.22f * std::abs(std::sin(9.0f * pi * u)) * (1.0f - v);
                const float rr = v >= 1.0f ? 0.0f : r * (1.0f - v) * rag;
                return Vertex{{rr * std::cos(a), y + 2.1f * v - 0.25f * (1.0f - v) * (1.0f - rag), -rr * std::sin(a)},
                    glm::normalize(vec3(std::cos(a), 0.55f, -std::sin(a))), {u, v}};
            },
            true);
    }
    const int fir_mesh = stage.mesh("fir", std::move(fir)), trunk_mesh = stage.mesh("fir trunk", std::move(trunk));
    for (int i = 0; i < 64; ++i) {
        const float r = i < 5 ? 17.0f + 3.0f * float(i) : 45.0f + 260.0f * random.next() * random.next();
        const float a = (i < 5 ? 0.62f * float(i) + 3.6f : glm::mix(2.7f, 6.7f, random.next()));
        const mat4 place
            = on_land(r * std::cos(a), r * std::sin(a)) * turned(360.0f * random.next()) * scaled(vec3(0.8f + 0.6f * random.next()));
        stage.place(fir_mesh, place), stage.place(trunk_mesh, place);
    }
}

} // namespace

Scene terrain(double detail)
{
    Stage stage("terrain", detail);
    const int soil = stage.texture(mottled("soil", {0.72f, 0.71f, 0.64f}, 0.3f, 16, 138));
    add_land(stage, stage.material("land", vec3(0.75f), 0.95f, soil));
    const int stone = stage.material("field stone", vec3(0.85f), 0.95f,
        stage.texture(stone_blocks("field stone", {0.7f, 0.66f, 0.6f}, {0.55f, 0.51f, 0.45f}, 4, 7, 139, 0.05f)));
    const int wood
        = stage.material("weathered wood", vec3(0.8f), 0.85f, stage.texture(planks("weathered wood", {0.55f, 0.45f, 0.36f}, 2, 140)));
    const int thatch = stage.material("thatch", vec3(0.85f), 0.95f, stage.texture(mottled("thatch", {0.7f, 0.58f, 0.36f}, 0.4f, 24, 141)));
    const int dark = stage.material("dark", {0.012f, 0.012f, 0.014f}, 0.9f);
    const int rock = stage.material("rock", {0.36f, 0.34f, 0.32f}, 0.95f);
    const int bark = stage.material("bark", {0.14f, 0.1f, 0.075f}, 0.95f);
    const int needles = stage.material("needles", {0.06f, 0.1f, 0.055f}, 0.9f);
    stage.edit(needles).double_sided = true;
    const int blades = stage.material("tufts", vec3(0.85f), 0.9f, stage.texture(grass_blades("blades", {0.66f, 0.64f, 0.36f}, 142)));
    stage.edit(blades).alpha = AlphaMode::mask;
    stage.edit(blades).alpha_cutoff = 0.4f;
    stage.edit(blades).double_sided = true;
    const std::vector<int> hut = add_hut(stage, stone, wood, thatch, dark);
    const vec3 huts[] = {{4.6f, -8.5f, -25.0f}, {-9.5f, -19.0f, 40.0f}, {9.0f, -24.0f, -60.0f}, {-22.0f, -46.0f, 15.0f},
        {2.0f, -58.0f, 80.0f}}; // x, z, degrees
    for (const vec3& h : huts)
        for (int part : hut) stage.place(part, on_land(h.x, h.y) * turned(h.z));
    add_rails(stage, wood);
    add_poles(stage, wood, stage.material("wire", {0.04f, 0.04f, 0.045f}, 0.5f));
    scatter(stage, rock, blades, bark, needles);
    const auto camera = [&](std::string name, vec2 from, float height, vec3 target, float fov) {
        stage.camera(std::move(name), {from.x, land(from.x, from.y) + height, from.y}, target, fov);
    };
    camera("valley", {-0.6f, 11.0f}, 1.8f, {0.4f, land(0, -12.0f) + 2.6f, -16.0f}, 55);
    camera("hilltop", {38.0f, 46.0f}, 24.0f, {-6.0f, 2.0f, -40.0f}, 50);
    camera("grazing", {-5.5f, 4.0f}, 0.7f, {2.5f, land(2.5f, -14.0f) + 1.6f, -14.0f}, 45);
    stage.sun("sun", 24, -62, 0.0f, {1.0f, 0.87f, 0.68f});
    stage.sun("soft sun", 24, -62, 0.53f, {1.0f, 0.87f, 0.68f});
    stage.sun("low sun", 8, 100, 0.53f, {1.0f, 0.66f, 0.4f});
    stage.point("lantern", {3.4f, land(3.4f, -6.2f) + 2.2f, -6.2f}, 0.1f, {1.0f, 0.66f, 0.32f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
