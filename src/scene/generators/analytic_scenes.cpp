// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/analytic_scenes.h"

#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

using namespace analytic_scenes;

constexpr vec3 warm_light{1.0f, 0.93f, 0.82f};

void add_floor(Stage& stage, float half, int cells)
{
    const int tiles = stage.texture(checker_tiles("floor tiles", vec3(0.80f, 0.78f, 0.74f), vec3(0.70f, 0.68f, 0.65f), 4, 11));
    MeshBuilder b = stage.builder(stage.material("floor", vec3(0.9f), 0.8f, tiles), 0.5f);
    b.patch(cells, cells, [&](float u, float v) {
        const float x = (2.0f * u - 1.0f) * half, z = (2.0f * v - 1.0f) * half;
        return Vertex{vec3(x, 0, z), vec3(0, 1, 0), vec2(x, z)};
    });
    stage.add("floor", std::move(b));
}

int sheet_material(Stage& stage, std::string name, vec3 base)
{
    const int m = stage.material(std::move(name), base, 0.7f);
    stage.edit(m).double_sided = true;
    return m;
}

/// A level sheet: without thickness, so that the closed form is exact.
void add_level_sheet(Stage& stage, std::string name, vec2 min, vec2 max, float y, vec3 base)
{
    MeshBuilder b = stage.builder(sheet_material(stage, name, base));
    b.quad(vec3(min.x, y, min.y), vec3(0, 0, max.y - min.y), vec3(max.x - min.x, 0, 0));
    stage.add(name, std::move(b));
}

} // namespace

Scene plane(double detail)
{
    Stage stage("plane", detail);
    add_floor(stage, 10.0f, 1);
    stage.camera("three-quarter", {0.0f, 3.2f, 9.0f}, {0, 0.2f, 0}, 50);
    stage.camera("grazing", {0.0f, 0.35f, 9.5f}, {0, 0.2f, 0}, 45);
    stage.sun("sun", 40, 60, 0.0f, warm_light);
    stage.sun("soft sun", 40, 60, 0.53f, warm_light);
    stage.sun("grazing sun", 3, 60, 0.0f, warm_light);
    stage.spot("spot", {2, 4, 2}, {0, 0, 0}, 60, 0.1f);
    stage.point("lamp", {0, 2.5f, 0}, 0.2f);
    stage.rect("panel", {0, 3, 0}, {1, 0, 0}, {0, 0, 0.5f});
    stage.disk("dish", {-2, 3, 0}, {0, 0, 0}, 0.5f);
    return std::move(stage).finish();
}

Scene tilted_planes(double detail)
{
    Stage stage("tilted_planes", detail);
    add_floor(stage, 10.0f, 1);
    // Turned about x by 5 degrees more each, side by side along x: a light without an x component never casts one on another.
    for (int i = 0; i < 18; ++i) {
        const float hue = float(i) / 17.0f;
        const vec3 color = glm::mix(vec3(0.7f, 0.3f, 0.08f), vec3(0.06f, 0.22f, 0.5f), hue);
        MeshBuilder b = stage.builder(sheet_material(stage, "card " + std::to_string(5 * i), color));
        b.transform = at({0.6f * (float(i) - 8.5f), 0.9f, 0.0f}) * turned(5.0f * float(i), vec3(1, 0, 0));
        b.quad({-0.27f, 0, -0.8f}, {0, 0, 1.6f}, {0.54f, 0, 0});
        stage.add("card " + std::to_string(5 * i), std::move(b));
    }
    stage.camera("front", {0.6f, 3.3f, 8.6f}, {0, 0.6f, 0}, 42);
    stage.camera("along the fan", {-7.5f, 1.9f, 4.2f}, {0, 0.8f, 0}, 45);
    stage.sun("sun", 80, 0, 0.0f, warm_light);
    stage.sun("soft sun", 50, 0, 0.53f, warm_light);
    stage.sun("low sun", 8, 0, 0.0f, warm_light);
    stage.spot("spot", {0, 7, 3}, {0, 0.5f, 0}, 80, 0.0f);
    stage.point("lamp", {0, 4, 1.5f}, 0.15f);
    return std::move(stage).finish();
}

Scene closed_box(double detail)
{
    Stage stage("closed_box", detail);
    const int bricks = stage.texture(stone_blocks("bricks", {0.72f, 0.66f, 0.58f}, {0.45f, 0.43f, 0.4f}, 4, 8, 3));
    MeshBuilder b = stage.builder(stage.material("walls", vec3(0.9f), 0.9f, bricks), 0.5f);
    b.box({0, 1.5f, 0}, {3.25f, 1.75f, 2.75f});
    // The room: the same shape with its faces turned in. Its quads face the middle.
    const vec3 lo(-3.0f, 0.0f, -2.5f), size(6.0f, 3.0f, 5.0f), hi = lo + size;
    const vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    b.quad(lo, z, x), b.quad(hi, -x, -z); // floor, ceiling
    b.quad(lo, x, y), b.quad(hi, -y, -x); // back, front
    b.quad(lo, y, z), b.quad(hi, -z, -y); // left, right
    stage.add("room", std::move(b));
    MeshBuilder things = stage.builder(stage.material("things", {0.55f, 0.3f, 0.2f}, 0.6f));
    things.sphere({-0.8f, 0.6f, 0.2f}, 0.6f, 32);
    things.box({1.1f, 0.5f, -0.4f}, {0.5f, 0.5f, 0.5f}, 0.05f);
    stage.add("things", std::move(things));
    stage.camera("inside", {0.4f, 1.7f, 2.2f}, {0, 0.7f, 0}, 65);
    stage.camera("corner", {2.7f, 2.6f, 2.2f}, {-0.6f, 0.3f, -0.4f}, 60);
    stage.sun("sun", 50, 30, 0.0f);
    stage.sun("soft sun", 50, 30, 2.0f);
    stage.spot("spot", {4, 6, 5}, {0, 1, 0}, 70, 0.2f);
    stage.point("lamp", {0, 5, 0}, 0.3f);
    stage.rect("panel", {0, 5, 0}, {1, 0, 0}, {0, 0, 1});
    stage.disk("dish", {0, 5, 0}, {0, 0, 0}, 0.8f);
    return std::move(stage).finish();
}

Scene half_plane(double detail)
{
    Stage stage("half_plane", detail);
    add_floor(stage, 10.0f, 1);
    add_level_sheet(
        stage, "half-plane", vec2(-half_plane_reach), {half_plane_edge_x, half_plane_reach}, half_plane_y, {0.32f, 0.42f, 0.5f});
    stage.camera("penumbra", {4.6f, 1.7f, 3.4f}, {0.9f, 0.15f, 0}, 50);
    stage.camera("from above", {3.4f, 7.0f, 2.5f}, {1.2f, 0, 0}, 45);
    stage.rect("main", {-1.2f, 4, 0}, {0.75f, 0, 0}, {0, 0, 0.5f}, warm_light);
    stage.disk("dish", {-1.2f, 4, 0}, {-1.2f, 0, 0}, 0.75f, warm_light);
    stage.rect("narrow panel", {-1.2f, 4, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}, warm_light);
    stage.sun("sun", 55, -90, 0.0f, warm_light);
    stage.sun("soft sun", 55, -90, 5.0f, warm_light);
    return std::move(stage).finish();
}

Scene rect_blocker(double detail)
{
    Stage stage("rect_blocker", detail);
    add_floor(stage, 10.0f, 1);
    add_level_sheet(stage, "rectangle", rect_blocker_min, rect_blocker_max, rect_blocker_y, {0.6f, 0.28f, 0.16f});
    stage.camera("three-quarter", {1.6f, 2.3f, 4.2f}, {0, 0.35f, 0}, 50);
    stage.camera("from below", {2.6f, 0.6f, 2.0f}, {0, 0.3f, 0}, 55);
    stage.rect("main", {0, 4, 0}, {0.5f, 0, 0}, {0, 0, 0.5f}, warm_light);
    stage.rect("wide panel", {0.5f, 3, 0.3f}, {1.4f, 0, 0}, {0, 0, 0.3f}, warm_light);
    stage.sun("sun", 60, 40, 0.0f, warm_light);
    stage.sun("soft sun", 60, 40, 4.0f, warm_light);
    stage.point("lamp", {0, 4, 0}, 0.4f, warm_light);
    return std::move(stage).finish();
}

Scene disk_blocker(double detail)
{
    Stage stage("disk_blocker", detail);
    add_floor(stage, 10.0f, 1);
    MeshBuilder b = stage.builder(sheet_material(stage, "disk", {0.2f, 0.42f, 0.28f}));
    const vec3 centre(disk_blocker_centre.x, disk_blocker_y, disk_blocker_centre.y);
    b.patch(
        disk_blocker_sides, 1,
        [&](float u, float v) {
            const float a = 2.0f * pi * u, r = disk_blocker_radius * v;
            return Vertex{centre + r * vec3(std::cos(a), 0, -std::sin(a)), vec3(0, 1, 0), r * vec2(std::cos(a), std::sin(a))};
        },
        true);
    stage.add("disk", std::move(b));
    stage.camera("three-quarter", {1.6f, 2.3f, 4.2f}, {0, 0.35f, 0}, 50);
    stage.camera("from below", {2.6f, 0.6f, 2.0f}, {0, 0.3f, 0}, 55);
    stage.disk("main", {0, 4, 0}, {0, 0, 0}, 0.5f, warm_light);
    stage.disk("large dish", {0.3f, 3, 0}, {0.3f, 0, 0}, 1.2f, warm_light);
    stage.sun("sun", 60, 40, 0.0f, warm_light);
    stage.sun("soft sun", 60, 40, 4.0f, warm_light);
    stage.point("lamp", {0, 4, 0}, 0.5f, warm_light);
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
