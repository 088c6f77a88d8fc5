// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/citadel_parts.h"
#include "scene/generators/masonry.h"
#include "scene/generators/noise.h"

namespace gnomon::scene::generators::citadel_parts {

namespace {

/// A dressed frame with a dark slit, proud of a wall whose face is z = 0.
void add_window(MeshBuilder& stone, MeshBuilder& dark, float x, float y, float w, float h)
{
    dark.box({x, y, 0}, {0.5f * w, 0.5f * h, 0.03f});
    for (float side : {-1.0f, 1.0f}) stone.box({x + side * (0.5f * w + 0.09f), y, 0}, {0.09f, 0.5f * h + 0.05f, 0.12f});
    stone.box({x, y + 0.5f * h + 0.1f, 0}, {0.5f * w + 0.25f, 0.11f, 0.14f}, 0.03f);
    stone.box({x, y - 0.5f * h - 0.08f, 0}, {0.5f * w + 0.25f, 0.08f, 0.17f}, 0.03f);
}

/// One straight wall of given length along x, inner face towards +z at z = 0, walk on top.
void add_wall(MeshBuilder& wall, MeshBuilder& trim, float length)
{
    const float h = wall_height, d = wall_depth, half = 0.5f * length;
    wall.box({0, 0.5f * h, -0.5f * d}, {half, 0.5f * h, 0.5f * d});
    // Batter: the foot spreads inwards and outwards.
    for (float side : {0.0f, 1.0f}) {
        const float z = side > 0.0f ? -d : 0.0f, out = side > 0.0f ? -0.45f : 0.3f;
        wall.hexahedron({{-half, 0, z}, {half, 0, z}, {-half, 1.4f, z}, {half, 1.4f, z}, {-half, 0, z + out}, {half, 0, z + out},
            {-half, 1.4f, z + 0.02f * out}, {half, 1.4f, z + 0.02f * out}});
    }
    trim.box({0, h + 0.09f, -0.5f * d}, {half, 0.09f, 0.5f * d + 0.12f}, 0.03f);
    wall.box({0, h + 0.6f, -d + 0.22f}, {half, 0.45f, 0.22f});
    wall.box({0, h + 0.42f, -0.1f}, {half, 0.25f, 0.14f});
    const mat4 saved = wall.transform;
    wall.transform = saved * at({0, h + 1.05f, -d + 0.22f});
    add_merlons(wall, length, 0.22f);
    wall.transform = saved;
    for (float x = -half + 1.5f; x < half; x += 3.0f) trim.box({x, h - 0.22f, 0.1f}, {0.16f, 0.22f, 0.2f}); // corbels
}

} // namespace

void add_merlons(MeshBuilder& b, float length, float depth)
{
    const int count = std::max(1, int(length / 1.7f));
    const float pitch = length / float(count);
    for (int i = 0; i < count; ++i) {
        const float x = pitch * (float(i) + 0.5f) - 0.5f * length;
        b.box({x, 0.42f, 0}, {0.29f * pitch, 0.42f, depth}, 0.05f);
        b.box({x, 0.88f, 0}, {0.33f * pitch, 0.07f, depth + 0.06f});
    }
}

void add_curtain_walls(Stage& stage, const Materials& m)
{
    MeshBuilder wall = stage.builder(m.wall, 0.33f), trim = stage.builder(m.dressed, 0.5f);
    const auto side = [&](const mat4& place, float length) {
        wall.transform = trim.transform = place;
        add_wall(wall, trim, length);
    };
    constexpr float gate = 3.4f; // half width of the gatehouse
    const float part = half_width - gate;
    for (float s : {-1.0f, 1.0f}) {
        side(at({s * (gate + 0.5f * part), 0, -half_depth}), part);
        side(at({s * half_width, 0, 0}) * turned(-s * 90.0f), 2.0f * half_depth);
    }
    side(at({0, 0, half_depth}) * turned(180), 2.0f * half_width);
    stage.add("curtain walls", std::move(wall));
    stage.add("wall trim", std::move(trim));
}

void add_towers(Stage& stage, const Materials& m)
{
    constexpr float r = 2.9f, h = 10.0f;
    MeshBuilder body = stage.builder(m.wall, 0.33f);
    body.lathe({{0, -0.2f}, {r + 0.55f, -0.2f}, {r + 0.05f, 2.0f}, {r, 2.0f}, {r, h - 1.0f}, {r + 0.5f, h - 0.4f}, {r + 0.5f, h + 0.7f},
                   {r + 0.1f, h + 0.7f}, {r + 0.1f, h}, {0, h}},
        28);
    for (int i = 0; i < 12; ++i) {
        body.transform = turned(30.0f * float(i)) * at({0, h + 0.7f, r + 0.3f});
        body.box({0, 0.4f, 0}, {0.45f, 0.4f, 0.2f}, 0.05f);
    }
    MeshBuilder trim = stage.builder(m.dressed, 0.5f), dark = stage.builder(m.dark);
    trim.lathe({{r - 0.1f, 6.0f}, {r + 0.14f, 6.0f}, {r + 0.14f, 6.22f}, {r - 0.1f, 6.22f}, {r - 0.1f, 6.0f}}, 28);
    for (int i = 0; i < 18; ++i) { // corbels under the parapet
        trim.transform = turned(20.0f * float(i)) * at({0, h - 0.75f, r + 0.16f});
        trim.box(vec3(0), {0.13f, 0.28f, 0.2f});
    }
    for (int i = 0; i < 6; ++i) {
        trim.transform = dark.transform = turned(60.0f * float(i) + 22.5f) * at({0, i % 2 ? 7.6f : 4.1f, r - 0.01f});
        add_window(trim, dark, 0, 0, 0.28f, 1.1f);
    }
    MeshBuilder roof = stage.builder(m.roof, 0.4f), wood = stage.builder(m.timber, 0.7f);
    roof.lathe({{0, h + 2.2f}, {r - 0.1f, h + 2.2f}, {r + 0.35f, h + 1.75f}, {r + 0.42f, h + 1.85f}, {1.5f, h + 4.6f}, {0.1f, h + 7.6f},
                   {0, h + 7.6f}},
        32);
    for (int i = 0; i < 8; ++i) {
        wood.transform = turned(45.0f * float(i)) * at({0, h, r - 0.35f});
        wood.box({0, 1.1f, 0}, {0.09f, 1.1f, 0.09f});
    }
    wood.transform = mat4(1);
    wood.cylinder({0, h + 7.3f, 0}, 0.05f, 2.2f, 8);
    const int parts[] = {stage.mesh("tower", std::move(body)), stage.mesh("tower trim", std::move(trim)),
        stage.mesh("tower slits", std::move(dark)), stage.mesh("tower roof", std::move(roof)), stage.mesh("tower wood", std::move(wood))};
    for (float x : {-1.0f, 1.0f})
        for (float z : {-1.0f, 1.0f})
            for (int part : parts)
                stage.place(part, at({x * (half_width + 0.9f), 0, z * (half_depth + 0.9f)}) * turned(90.0f * x + 11.0f * z));
}

void add_gate(Stage& stage, const Materials& m)
{
    const float z = -half_depth - 1.3f;
    const ArchedWall arch{.width = 5.2f, .bottom = 0, .top = 8.4f, .depth = 3.6f, .opening = 3.4f, .sill = 0, .spring = 2.7f, .rise = 0.6f};
    MeshBuilder wall = stage.builder(m.wall, 0.33f), trim = stage.builder(m.dressed, 0.5f), dark = stage.builder(m.dark);
    wall.transform = trim.transform = dark.transform = at({0, 0, z});
    add_arched_wall(wall, arch);
    add_arch_moulding(trim, arch, 0.42f, 0.12f);
    trim.box({0, 5.55f, 1.85f}, {2.6f, 0.12f, 0.14f}, 0.04f);
    for (float s : {-1.0f, 1.0f}) {
        wall.transform = at({s * 3.1f, 0, z});
        wall.lathe({{0, -0.2f}, {1.75f, -0.2f}, {1.55f, 1.6f}, {1.5f, 1.6f}, {1.5f, 8.0f}, {1.75f, 8.4f}, {1.75f, 9.2f}, {0, 9.2f}}, 24);
        for (int i = 0; i < 8; ++i) {
            wall.transform = at({s * 3.1f, 9.2f, z}) * turned(45.0f * float(i)) * at({0, 0, 1.55f});
            wall.box({0, 0.36f, 0}, {0.36f, 0.36f, 0.18f}, 0.04f);
        }
        trim.transform = dark.transform = at({s * 3.1f, 4.6f, z + 1.49f});
        add_window(trim, dark, 0, 0, 0.24f, 1.0f);
    }
    wall.transform = trim.transform = dark.transform = at({0, 8.4f, z});
    add_merlons(wall, 3.0f, 1.75f);
    for (float x : {-0.9f, 0.9f}) {
        trim.transform = dark.transform = at({x, 6.7f, z + 1.8f});
        add_window(trim, dark, 0, 0, 0.5f, 0.9f);
    }
    stage.add("gatehouse", std::move(wall));
    stage.add("gatehouse trim", std::move(trim));
    stage.add("gatehouse windows", std::move(dark));

    MeshBuilder iron = stage.builder(m.iron), doors = stage.builder(m.planks, 0.6f);
    iron.transform = at({0, 0, z - 0.6f});
    for (int i = 0; i < 9; ++i) { // the portcullis, half raised
        const float x = 0.39f * (float(i) - 4.0f);
        iron.box({x, 3.3f, 0}, {0.035f, 1.5f, 0.035f});
        iron.hexahedron({{x - 0.05f, 1.8f, -0.05f}, {x + 0.05f, 1.8f, -0.05f}, {x - 0.005f, 1.55f, -0.005f}, {x + 0.005f, 1.55f, -0.005f},
            {x - 0.05f, 1.8f, 0.05f}, {x + 0.05f, 1.8f, 0.05f}, {x - 0.005f, 1.55f, 0.005f}, {x + 0.005f, 1.55f, 0.005f}});
    }
    for (int i = 0; i < 7; ++i) iron.box({0, 2.0f + 0.39f * float(i), 0}, {1.7f, 0.03f, 0.03f});
    for (float s : {-1.0f, 1.0f}) {
        doors.transform = iron.transform = at({s * 1.66f, 0, z + 1.7f}) * turned(-s * 68.0f);
        doors.box({-s * 0.8f, 1.45f, 0}, {0.8f, 1.4f, 0.07f}, 0.015f);
        for (float y : {0.6f, 1.5f, 2.4f}) iron.box({-s * 0.7f, y, 0}, {0.68f, 0.05f, 0.085f}, 0.01f);
    }
    stage.add("portcullis", std::move(iron));
    stage.add("gate doors", std::move(doors));
}

void add_keep(Stage& stage, const Materials& m)
{
    const mat4 base = at({-9.6f, 0, -9.2f});
    constexpr float half = 4.2f, h = 14.0f;
    MeshBuilder wall = stage.builder(m.wall, 0.33f), trim = stage.builder(m.dressed, 0.5f), dark = stage.builder(m.dark),
                wood = stage.builder(m.timber, 0.7f);
    wall.transform = trim.transform = base;
    wall.box({0, 0.5f * h, 0}, {half, 0.5f * h, half});
    wall.box({0, 0.6f, 0}, {half + 0.3f, 0.6f, half + 0.3f}, 0.2f);
    trim.box({0, 5.0f, 0}, {half + 0.1f, 0.12f, half + 0.1f}, 0.04f);
    trim.box({0, h - 0.1f, 0}, {half + 0.3f, 0.16f, half + 0.3f}, 0.05f);
    for (int corner = 0; corner < 4; ++corner) { // quoins, long and short by turns
        const vec2 c(corner & 1 ? half : -half, corner & 2 ? half : -half);
        for (int i = 0; i < 16; ++i) {
            const bool odd = i & 1;
            const vec2 size(odd ? 0.55f : 0.36f, odd ? 0.36f : 0.55f);
            trim.tint = vec3(0.88f + 0.12f * hash01(uint32_t(i), uint32_t(corner), 81));
            trim.box({c.x - glm::sign(c.x) * (size.x - 0.07f), 1.6f + 0.78f * float(i), c.y - glm::sign(c.y) * (size.y - 0.07f)},
                {size.x, 0.375f, size.y}, 0.045f);
        }
    }
    trim.tint = vec3(1);
    for (int side = 0; side < 4; ++side) {
        const mat4 face = base * turned(90.0f * float(side));
        trim.transform = dark.transform = face * at({0, 0, half + 0.01f});
        for (float x : {-2.0f, 2.0f}) add_window(trim, dark, x, 8.2f, 0.6f, 1.5f);
        add_window(trim, dark, 0, 11.6f, 0.8f, 1.3f);
        if (side != 0) add_window(trim, dark, 0, 3.4f, 0.35f, 1.1f);
        wall.transform = face * at({0, h + 0.06f, half + 0.05f});
        add_merlons(wall, 2.0f * half + 0.5f, 0.22f);
    }
    wood.transform = base * at({0, 0, half}); // the door, its porch and a timber gallery above it
    wood.box({0, 1.45f, 0.05f}, {0.8f, 1.4f, 0.1f}, 0.03f);
    wood.box({0, 7.0f, 0.75f}, {3.2f, 0.08f, 0.75f}, 0.02f);
    wood.box({0, 7.95f, 1.42f}, {3.2f, 0.06f, 0.06f}, 0.015f);
    for (int i = 0; i < 13; ++i) wood.box({-3.1f + 0.516f * float(i), 7.5f, 1.42f}, {0.04f, 0.45f, 0.04f});
    for (float x : {-2.8f, 0.0f, 2.8f})
        wood.hexahedron({{x - 0.1f, 5.6f, 0}, {x + 0.1f, 5.6f, 0}, {x - 0.1f, 5.9f, 0}, {x + 0.1f, 5.9f, 0}, {x - 0.1f, 6.75f, 1.3f},
            {x + 0.1f, 6.75f, 1.3f}, {x - 0.1f, 6.95f, 1.3f}, {x + 0.1f, 6.95f, 1.3f}});
    trim.transform = base * at({0, 0, half + 0.6f});
    for (int i = 0; i < 3; ++i) trim.box({0, 0.11f + 0.2f * float(2 - i), 0.35f * float(i)}, {1.5f + 0.1f * float(i), 0.11f, 0.4f}, 0.03f);
    MeshBuilder roof = stage.builder(m.slate, 0.4f);
    roof.transform = base * at({0, h + 0.1f, 0});
    const float e = half - 0.55f;
    roof.hexahedron({{-e, 0, -e}, {e, 0, -e}, {-0.25f, 5.0f, -0.25f}, {0.25f, 5.0f, -0.25f}, {-e, 0, e}, {e, 0, e}, {-0.25f, 5.0f, 0.25f},
        {0.25f, 5.0f, 0.25f}});
    wood.transform = base;
    wood.cylinder({0, h + 4.8f, 0}, 0.07f, 3.4f, 8);
    stage.add("keep", std::move(wall));
    stage.add("keep trim", std::move(trim));
    stage.add("keep windows", std::move(dark));
    stage.add("keep wood", std::move(wood));
    stage.add("keep roof", std::move(roof));
}

void add_stairs(Stage& stage, const Materials& m)
{
    MeshBuilder stone = stage.builder(m.dressed, 0.5f), wall = stage.builder(m.wall, 0.33f);
    constexpr int steps = 20;
    const float rise = wall_height / float(steps), run = 0.42f;
    for (int i = 0; i < steps; ++i) {
        const float y = rise * float(i + 1), z = 9.0f - run * float(i);
        stone.tint = vec3(0.88f + 0.12f * hash01(uint32_t(i), 82));
        stone.box({half_width - 0.95f, y - 0.09f, z}, {0.95f, 0.09f, 0.5f * run + 0.05f}, 0.03f);
        wall.box({half_width - 0.95f, 0.5f * (y - 0.18f), z}, {0.85f, 0.5f * std::max(0.05f, y - 0.18f), 0.5f * run});
    }
    wall.box(
        {half_width - 0.95f, 0.5f * wall_height - 0.05f, 9.0f - run * float(steps) - 0.7f}, {0.85f, 0.5f * wall_height - 0.05f, 0.92f});
    stage.add("stair treads", std::move(stone));
    stage.add("stair", std::move(wall));
}

} // namespace gnomon::scene::generators::citadel_parts
