// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

/// A chair of round-edged boards; its feet stand on y = 0.
void add_chair(MeshBuilder& wood)
{
    constexpr float seat = 0.45f, half = 0.2f;
    for (float x : {-half, half}) {
        wood.box({x, 0.5f * seat, half}, {0.018f, 0.5f * seat, 0.018f}, 0.006f);
        wood.box({x, 0.47f, -half}, {0.018f, 0.47f, 0.018f}, 0.006f);
        wood.box({x, 0.2f, 0}, {0.01f, 0.014f, half}, 0.004f);
    }
    wood.box({0, seat + 0.012f, 0}, {half + 0.03f, 0.014f, half + 0.03f}, 0.01f);
    for (float y : {0.62f, 0.74f, 0.86f}) wood.box({0, y, -half}, {half, 0.03f, 0.008f}, 0.005f);
    wood.box({0, 0.27f, half}, {half, 0.014f, 0.01f}, 0.004f);
}

void add_room(Stage& stage)
{
    const int boards = stage.texture(planks("floorboards", {0.66f, 0.49f, 0.33f}, 8, 21));
    const int plaster = stage.texture(mottled("plaster", {0.85f, 0.82f, 0.76f}, 0.08f, 6, 22));
    MeshBuilder floor = stage.builder(stage.material("floorboards", vec3(0.9f), 0.6f, boards), 0.8f);
    floor.box({0, -0.1f, 0.8f}, {4.0f, 0.1f, 2.8f});
    stage.add("floor", std::move(floor));
    MeshBuilder wall = stage.builder(stage.material("plaster", vec3(0.95f), 0.95f, plaster), 0.4f);
    wall.box({0, 1.3f, -2.1f}, {4.0f, 1.5f, 0.1f});
    stage.add("wall", std::move(wall));
    MeshBuilder skirting = stage.builder(stage.material("skirting", vec3(0.72f, 0.7f, 0.64f), 0.5f));
    skirting.box({0, 0.06f, -1.985f}, {4.0f, 0.06f, 0.015f}, 0.006f);
    stage.add("skirting", std::move(skirting));
}

void add_cubes_and_spheres(Stage& stage)
{
    MeshBuilder red = stage.builder(stage.material("red", {0.62f, 0.13f, 0.08f}, 0.5f));
    red.transform = at({-0.35f, 0.16f, 0.75f}) * turned(24);
    red.box(vec3(0), vec3(0.16f), 0.008f);
    red.transform = at({-0.32f, 0.32f + 0.09f, 0.73f}) * turned(50);
    red.box(vec3(0), vec3(0.09f));
    stage.add("red cubes", std::move(red));
    MeshBuilder blue = stage.builder(stage.material("blue", {0.08f, 0.2f, 0.42f}, 0.35f));
    blue.sphere({0.25f, 0.2f, 1.15f}, 0.2f, 32);
    blue.sphere({0.62f, 0.1f, 1.3f}, 0.1f, 24);
    blue.sphere({-0.78f, 0.07f, 1.25f}, 0.07f, 20);
    stage.add("blue spheres", std::move(blue));
    MeshBuilder white = stage.builder(stage.material("white", {0.78f, 0.76f, 0.72f}, 0.6f));
    white.transform = at({1.05f, 0, 0.55f});
    white.lathe({{0, 0}, {0.1f, 0}, {0.13f, 0.03f}, {0.2f, 0.16f}, {0.19f, 0.3f}, {0.1f, 0.42f}, {0.09f, 0.47f}, {0.13f, 0.52f},
                    {0.115f, 0.52f}, {0.075f, 0.47f}, {0, 0.46f}},
        32);
    white.transform = mat4(1);
    white.torus({0.45f, 0.045f, 0.45f}, 0.17f, 0.045f, 32, 14);
    stage.add("pottery", std::move(white));
}

/// Sheets that stand on the floor or lean on the wall, and cards at rising tilts: contact along a line.
void add_sheets(Stage& stage)
{
    const int green = stage.material("card", {0.2f, 0.42f, 0.22f}, 0.8f);
    const int cream = stage.material("paper", {0.82f, 0.76f, 0.6f}, 0.9f);
    stage.edit(green).double_sided = stage.edit(cream).double_sided = true;
    MeshBuilder cards = stage.builder(green);
    for (int i = 0; i < 5; ++i) {
        cards.transform
            = at({-1.45f + 0.13f * float(i), 0, 1.55f - 0.3f * float(i)}) * turned(30) * turned(15.0f + 15.0f * float(i), vec3(1, 0, 0));
        cards.quad({-0.15f, 0, 0}, {0.3f, 0, 0}, {0, 0, -0.26f});
    }
    stage.add("tilted cards", std::move(cards));
    MeshBuilder paper = stage.builder(cream);
    paper.quad({-0.5f, 0, -1.5f}, {0.75f, 0, 0}, {0, 1.15f, -0.47f}); // leans on the wall
    paper.transform = at({1.5f, 0, 1.2f}) * turned(-35);
    paper.patch(14, 1, [](float u, float v) { // a scroll standing on its edge
        const float a = glm::mix(-0.4f, 2.6f, u), r = 0.3f - 0.05f * u;
        return Vertex{{r * std::cos(a), 0.42f * v, r * std::sin(a)}, {std::cos(a), 0, std::sin(a)}, {u, v}};
    });
    stage.add("paper", std::move(paper));
    MeshBuilder rods = stage.builder(stage.material("brass", {0.55f, 0.38f, 0.14f}, 0.35f));
    rods.tube({{0.75f, 0, -1.45f}, {0.95f, 1.75f, -1.99f}}, 0.012f, 0.012f, 10);
    rods.tube({{0.95f, 0, -1.5f}, {1.0f, 1.4f, -1.99f}}, 0.006f, 0.006f, 8);
    rods.tube({{-0.05f, 0.008f, 1.65f}, {0.75f, 0.008f, 1.85f}}, 0.008f, 0.008f, 8);
    stage.add("rods", std::move(rods));
}

} // namespace

Scene contact(double detail)
{
    Stage stage("contact", detail);
    add_room(stage);
    const int grain = stage.texture(planks("wood", {0.56f, 0.36f, 0.2f}, 2, 23));
    MeshBuilder wood = stage.builder(stage.material("chair wood", vec3(0.8f), 0.5f, grain), 2.0f);
    add_chair(wood);
    const int chair = stage.mesh("chair", std::move(wood));
    stage.place(chair, at({-1.25f, 0, -0.55f}) * turned(35));
    stage.place(chair, at({1.75f, 0, -0.75f}) * turned(-25));
    stage.place(chair, at({0.55f, 0.22f, -0.35f}) * turned(-60) * turned(-90, vec3(1, 0, 0))); // lies on its back
    add_cubes_and_spheres(stage);
    add_sheets(stage);
    stage.camera("room", {0.5f, 1.35f, 4.1f}, {0.05f, 0.42f, -0.1f}, 42);
    stage.camera("floor", {-1.9f, 0.32f, 2.5f}, {0.1f, 0.28f, 0.3f}, 45);
    stage.camera("from above", {1.7f, 2.6f, 2.6f}, {0.1f, 0.1f, 0.2f}, 42);
    stage.sun("sun", 38, 55, 0.0f, {1.0f, 0.91f, 0.78f});
    stage.sun("soft sun", 38, 55, 1.5f, {1.0f, 0.91f, 0.78f});
    stage.spot("spot", {-2.2f, 3, 2.5f}, {0, 0, 0}, 65, 0.06f, {1.0f, 0.88f, 0.7f});
    stage.point("lamp", {0.2f, 2.2f, 0.9f}, 0.1f, {1.0f, 0.82f, 0.6f});
    stage.rect("window", {3.2f, 2.2f, 1.8f}, {0, 0.7f, 0}, {-0.35f, 0, 0.5f}, {0.85f, 0.93f, 1.0f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
