// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/generators.h"
#include "scene/generators/masonry.h"
#include "scene/generators/noise.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

// The hall runs along z: a nave between two rows of columns, aisles beside it. Metres.
constexpr int bays = 6;
constexpr float bay = 4.0f, nave = 4.0f, aisle = 7.6f; // half widths
constexpr float capital = 4.2f, gallery = 7.0f, spring = 8.4f, crown = 12.6f;
constexpr float half_length = 0.5f * bay * bays;

float bay_z(int i) { return bay * (float(i) - 0.5f * (bays - 1)); }

struct Materials {
    int wall, dressed, vault, floor, wood, metal, cloth;
};

Materials make_materials(Stage& stage)
{
    const int blocks = stage.texture(stone_blocks("ashlar", {0.83f, 0.76f, 0.65f}, {0.66f, 0.6f, 0.52f}, 3, 6, 51, 0.02f));
    const int fine = stage.texture(mottled("dressed stone", {0.86f, 0.8f, 0.7f}, 0.1f, 6, 52));
    const int plaster = stage.texture(mottled("vault plaster", {0.9f, 0.87f, 0.8f}, 0.07f, 6, 53));
    const int tiles = stage.texture(checker_tiles("floor tiles", {0.84f, 0.79f, 0.7f}, {0.5f, 0.34f, 0.28f}, 4, 54));
    const int grain = stage.texture(planks("oak", {0.5f, 0.34f, 0.21f}, 3, 55));
    Materials m{};
    m.wall = stage.material("ashlar", vec3(0.85f), 0.95f, blocks);
    m.dressed = stage.material("dressed stone", vec3(0.85f), 0.85f, fine);
    m.vault = stage.material("vault plaster", vec3(0.9f), 0.95f, plaster);
    stage.edit(m.vault).double_sided = true;
    m.floor = stage.material("floor tiles", vec3(0.8f), 0.35f, tiles);
    m.wood = stage.material("oak", vec3(0.75f), 0.6f, grain);
    m.metal = stage.material("brass", {0.6f, 0.42f, 0.16f}, 0.35f);
    m.cloth = stage.material("altar cloth", {0.45f, 0.05f, 0.06f}, 0.95f);
    return m;
}

void add_columns_and_arcades(Stage& stage, const Materials& m)
{
    MeshBuilder column = stage.builder(m.dressed, 0.5f);
    add_column(column, 0.42f, capital, 24);
    const int column_mesh = stage.mesh("column", std::move(column));
    MeshBuilder shaft = stage.builder(m.dressed, 0.5f);
    shaft.cylinder({0, capital, 0}, 0.14f, spring - capital, 12);
    shaft.lathe({{0, spring - 0.25f}, {0.14f, spring - 0.25f}, {0.25f, spring}, {0, spring}}, 12);
    const int shaft_mesh = stage.mesh("wall shaft", std::move(shaft));
    for (int i = 0; i <= bays; ++i) {
        for (float side : {-1.0f, 1.0f}) {
            const float z = bay_z(i) - 0.5f * bay;
            stage.place(column_mesh, at({side * nave, 0, z}));
            stage.place(shaft_mesh, at({side * (nave - 0.42f), 0, z}));
        }
    }
    const ArchedWall arcade{.width = bay,
        .bottom = capital,
        .top = gallery,
        .depth = 0.7f,
        .opening = 3.1f,
        .sill = capital,
        .spring = capital + 0.02f,
        .rise = 0.72f};
    const ArchedWall clerestory{
        .width = bay, .bottom = gallery, .top = crown + 0.3f, .depth = 0.6f, .opening = 1.5f, .sill = 8.2f, .spring = 9.7f, .rise = 0.866f};
    MeshBuilder wall = stage.builder(m.wall, 0.4f);
    add_arched_wall(wall, arcade);
    add_arched_wall(wall, clerestory);
    const int wall_mesh = stage.mesh("nave wall", std::move(wall));
    MeshBuilder trim = stage.builder(m.dressed, 0.5f);
    add_arch_moulding(trim, arcade, 0.2f, 0.06f);
    add_arch_moulding(trim, clerestory, 0.12f, 0.05f);
    trim.box({0, gallery, 0}, {0.5f * bay, 0.09f, 0.43f}, 0.04f);
    const int trim_mesh = stage.mesh("nave wall trim", std::move(trim));
    for (int i = 0; i < bays; ++i) {
        for (float side : {-1.0f, 1.0f}) {
            const mat4 place = at({side * nave, 0, bay_z(i)}) * turned(-side * 90.0f);
            stage.place(wall_mesh, place);
            stage.place(trim_mesh, place);
        }
    }
}

/// Bars of a two-light window: a mullion and two small heads under a ring.
void add_tracery(MeshBuilder& b, const ArchedWall& w)
{
    b.box({0, 0.5f * (w.sill + w.spring), 0}, {0.06f, 0.5f * (w.spring - w.sill), 0.09f}, 0.02f);
    for (float side : {-1.0f, 1.0f}) {
        std::vector<vec3> path;
        for (vec2 p : arch_head(0.5f * w.opening, w.spring, 0.8f, 7)) path.emplace_back(p.x + side * 0.25f * w.opening, p.y, 0.0f);
        b.sweep(path, {{-0.06f, -0.045f}, {0.06f, -0.045f}, {0.06f, 0.045f}, {-0.06f, 0.045f}}, vec3(0, 0, 1));
    }
    for (float t : {0.33f, 0.66f}) b.box({0, glm::mix(w.sill, w.spring, t), 0}, {0.5f * w.opening, 0.02f, 0.02f});
    const mat4 saved = b.transform;
    b.transform = b.transform * at({0, w.spring + 0.58f * w.opening, 0}) * turned(90, vec3(1, 0, 0));
    b.torus(vec3(0), 0.15f * w.opening, 0.05f, 20, 8);
    b.transform = saved;
}

void add_aisles(Stage& stage, const Materials& m)
{
    const ArchedWall window{
        .width = bay, .bottom = 0, .top = gallery + 0.2f, .depth = 0.7f, .opening = 2.3f, .sill = 1.4f, .spring = 4.3f, .rise = 0.866f};
    MeshBuilder wall = stage.builder(m.wall, 0.4f);
    add_arched_wall(wall, window);
    const int wall_mesh = stage.mesh("aisle wall", std::move(wall));
    MeshBuilder trim = stage.builder(m.dressed, 0.5f);
    add_arch_moulding(trim, window, 0.15f, 0.05f);
    add_tracery(trim, window);
    trim.box({0, window.sill - 0.05f, 0}, {0.62f * window.opening, 0.07f, 0.46f}, 0.03f);
    trim.box({0.5f * bay, 0.5f * gallery, 0.4f}, {0.3f, 0.5f * gallery, 0.22f}, 0.03f); // pilaster
    const int trim_mesh = stage.mesh("aisle wall trim", std::move(trim));
    MeshBuilder roof = stage.builder(m.wood, 0.5f);
    const float width = 0.5f * (aisle + 0.35f - nave + 0.3f);
    roof.box({0, gallery + 0.3f, 0}, {width, 0.1f, 0.5f * bay});
    for (float z : {-1.6f, -0.8f, 0.0f, 0.8f, 1.6f}) roof.box({0, gallery + 0.11f, z}, {width, 0.11f, 0.08f}, 0.01f);
    const int roof_mesh = stage.mesh("aisle roof", std::move(roof));
    for (int i = 0; i < bays; ++i) {
        for (float side : {-1.0f, 1.0f}) {
            const mat4 place = at({side * aisle, 0, bay_z(i)}) * turned(-side * 90.0f);
            stage.place(wall_mesh, place);
            stage.place(trim_mesh, place);
            stage.place(roof_mesh, at({side * (nave - 0.3f + width), 0, bay_z(i)}));
        }
    }
}

/// Height of a groin vault: the higher of two elliptic barrels that cross.
float vault_height(float x, float z)
{
    const auto barrel = [](float t) { return std::sqrt(std::max(0.0f, 1.0f - t * t)); };
    return spring + (crown - spring) * std::max(barrel(x / nave), barrel(z / (0.5f * bay)));
}

void add_vault(Stage& stage, const Materials& m)
{
    MeshBuilder cells = stage.builder(m.vault, 0.3f);
    // Squeezed towards the sides, where the ellipse is steep: x = sin of an even angle.
    cells.patch(24, 16, [](float u, float v) {
        const auto place = [](float s, float t) {
            const float x = nave * std::sin(0.5f * pi * (2.0f * s - 1.0f)), z = 0.5f * bay * std::sin(0.5f * pi * (2.0f * t - 1.0f));
            return vec3(x, vault_height(x, z), z);
        };
        const float h = 0.004f;
        const vec3 du = place(u + h, v) - place(u - h, v), dv = place(u, v + h) - place(u, v - h);
        const vec3 n = glm::cross(du, dv);
        return Vertex{place(u, v), glm::length(n) > 1e-12f ? glm::normalize(n) : vec3(0, -1, 0), vec2(6.0f * u, 4.0f * v)};
    });
    const int cells_mesh = stage.mesh("vault", std::move(cells));
    MeshBuilder ribs = stage.builder(m.dressed, 0.5f);
    const std::vector<vec2> profile = {{-0.13f, -0.12f}, {0.13f, -0.12f}, {0.13f, 0.06f}, {0.06f, 0.16f}, {-0.06f, 0.16f}, {-0.13f, 0.06f}};
    const auto add_rib = [&](vec2 from, vec2 to, const std::vector<vec2>& shape) {
        std::vector<vec3> path;
        const int count = 20;
        for (int i = 0; i <= count; ++i) {
            const float t = -std::cos(pi * float(i) / float(count));
            const vec2 p = glm::mix(from, to, 0.5f + 0.5f * t);
            path.emplace_back(p.x, spring + (crown - spring) * std::sqrt(std::max(0.0f, 1.0f - t * t)), p.y);
        }
        const vec3 along(to.x - from.x, 0, to.y - from.y);
        ribs.sweep(path, shape, glm::cross(along, vec3(0, 1, 0)));
    };
    const float z = 0.5f * bay;
    add_rib({-nave, -z}, {nave, z}, profile);
    add_rib({-nave, z}, {nave, -z}, profile);
    std::vector<vec2> broad = profile;
    for (vec2& p : broad) p *= 1.5f;
    add_rib({-nave, -z}, {nave, -z}, broad);
    ribs.cylinder({0, crown - 0.22f, 0}, 0.3f, 0.3f, 16, 0.06f);
    const int ribs_mesh = stage.mesh("vault ribs", std::move(ribs));
    for (int i = 0; i < bays; ++i) {
        stage.place(cells_mesh, at({0, 0, bay_z(i)}));
        stage.place(ribs_mesh, at({0, 0, bay_z(i)}));
    }
}

void add_floor_and_ends(Stage& stage, const Materials& m)
{
    MeshBuilder floor = stage.builder(m.floor, 0.5f);
    floor.box({0, -0.15f, 0}, {aisle + 0.35f, 0.15f, half_length + 0.7f});
    stage.add("floor", std::move(floor));
    const ArchedWall great{.width = 2.0f * nave + 0.6f,
        .bottom = 0,
        .top = crown + 0.3f,
        .depth = 0.7f,
        .opening = 3.4f,
        .sill = 3.2f,
        .spring = 7.4f,
        .rise = 0.866f};
    MeshBuilder ends = stage.builder(m.wall, 0.4f);
    MeshBuilder trim = stage.builder(m.dressed, 0.5f);
    ends.transform = trim.transform = at({0, 0, -half_length - 0.35f});
    add_arched_wall(ends, great);
    add_arch_moulding(trim, great, 0.25f, 0.08f);
    add_tracery(trim, great);
    for (float x : {-0.85f, 0.85f})
        trim.box({x, 0.5f * (great.sill + great.spring), 0}, {0.04f, 0.5f * (great.spring - great.sill), 0.06f});
    ends.transform = mat4(1);
    ends.box({0, 0.5f * crown, half_length + 0.35f}, {nave + 0.3f, 0.5f * crown + 0.3f, 0.35f});
    for (float side : {-1.0f, 1.0f}) {
        const float width = 0.5f * (aisle + 0.35f - nave - 0.3f);
        for (float end : {-1.0f, 1.0f})
            ends.box(
                {side * (nave + 0.3f + width), 0.5f * gallery + 0.2f, end * (half_length + 0.35f)}, {width, 0.5f * gallery + 0.2f, 0.35f});
    }
    stage.add("end walls", std::move(ends));
    stage.add("great window", std::move(trim));
}

void add_furniture(Stage& stage, const Materials& m)
{
    MeshBuilder pew = stage.builder(m.wood, 1.0f);
    pew.box({0, 0.44f, 0}, {1.15f, 0.025f, 0.2f}, 0.012f);
    pew.box({0, 0.72f, 0.21f}, {1.15f, 0.28f, 0.02f}, 0.012f);
    pew.box({0, 0.98f, 0.19f}, {1.18f, 0.025f, 0.06f}, 0.015f);
    for (float x : {-1.15f, 1.15f}) pew.box({x, 0.48f, 0.02f}, {0.035f, 0.48f, 0.24f}, 0.015f);
    const int pew_mesh = stage.mesh("pew", std::move(pew));
    for (int i = 0; i < 9; ++i)
        for (float side : {-1.0f, 1.0f}) stage.place(pew_mesh, at({side * 1.95f, 0, 5.5f - 1.1f * float(i)}));

    const float back = -half_length + 0.6f;
    MeshBuilder steps = stage.builder(m.dressed, 0.5f);
    for (int i = 0; i < 3; ++i)
        steps.box({0, 0.08f + 0.16f * float(i), back + 1.0f}, {3.2f - 0.4f * float(i), 0.08f, 1.9f - 0.4f * float(i)}, 0.02f);
    steps.box({0, 0.95f, back + 0.6f}, {1.2f, 0.5f, 0.45f}, 0.03f);
    stage.add("altar", std::move(steps));
    MeshBuilder cloth = stage.builder(m.cloth);
    cloth.box({0, 1.46f, back + 0.6f}, {1.26f, 0.02f, 0.5f}, 0.01f);
    cloth.box({0, 1.2f, back + 1.08f}, {0.5f, 0.26f, 0.01f}, 0.004f);
    stage.add("altar cloth", std::move(cloth));
    MeshBuilder stick = stage.builder(m.metal);
    stick.lathe({{0, 0}, {0.16f, 0}, {0.17f, 0.03f}, {0.06f, 0.09f}, {0.03f, 0.16f}, {0.05f, 0.24f}, {0.025f, 0.32f}, {0.025f, 0.8f},
                    {0.05f, 0.86f}, {0.11f, 0.93f}, {0.12f, 0.96f}, {0, 0.96f}},
        16);
    const int stick_mesh = stage.mesh("candlestick", std::move(stick));
    for (float x : {-0.95f, 0.95f}) stage.place(stick_mesh, at({x, 1.48f, back + 0.6f}));
    for (float x : {-2.3f, 2.3f}) stage.place(stick_mesh, at({x, 0.32f, back + 1.5f}) * scaled(vec3(1.5f)));
}

} // namespace

Scene colonnade(double detail)
{
    Stage stage("colonnade", detail);
    const Materials m = make_materials(stage);
    add_floor_and_ends(stage, m);
    add_columns_and_arcades(stage, m);
    add_aisles(stage, m);
    add_vault(stage, m);
    add_furniture(stage, m);
    stage.camera("nave", {0.9f, 1.75f, 11.2f}, {-0.35f, 4.1f, -4.0f}, 68);
    stage.camera("aisle", {-5.9f, 1.7f, 10.6f}, {-4.0f, 2.7f, -3.0f}, 60);
    stage.camera("altar", {-1.7f, 2.3f, -1.5f}, {0.9f, 2.9f, -12.0f}, 60);
    stage.sun("sun", 31, 82, 0.0f, {1.0f, 0.9f, 0.74f});
    stage.sun("soft sun", 31, 82, 0.53f, {1.0f, 0.9f, 0.74f});
    stage.rect("great window", {0, 6.6f, -half_length + 0.3f}, {1.5f, 0, 0}, {0, 2.8f, 0}, {0.8f, 0.9f, 1.0f});
    stage.point("candle", {-0.95f, 2.55f, -half_length + 1.2f}, 0.03f, {1.0f, 0.7f, 0.36f});
    stage.spot("spot", {2.6f, 9.0f, 6.0f}, {-1.0f, 0, -3.0f}, 50, 0.1f, {1.0f, 0.92f, 0.8f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
