// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

constexpr float sun_elevation = 85.0f;

/// Things before a board whose face is z = 0 and whose foot is y = 0: a ball and a cube that touch it, a peg that stands on it, a bar
/// that floats. At `t` degrees from the light a thing at height h casts its shadow h tan(t) down the board.
void add_casters(MeshBuilder& casters)
{
    casters.sphere({-0.2f, 1.15f, 0.06f}, 0.06f, 16);
    casters.box({0.2f, 0.8f, 0.04f}, vec3(0.04f));
    casters.tube({{0.02f, 1.3f, 0.0f}, {0.02f, 1.3f, 0.1f}}, 0.012f, 0.012f, 10);
    casters.tube({{-0.28f, 0.85f, 0.035f}, {-0.02f, 0.85f, 0.035f}}, 0.01f, 0.01f, 10);
}

} // namespace

Scene grazing(double detail)
{
    Stage stage("grazing", detail);
    const int plaster = stage.texture(mottled("plaster", {0.84f, 0.84f, 0.82f}, 0.06f, 6, 37));
    MeshBuilder ground = stage.builder(stage.material("ground", vec3(0.8f), 0.9f, plaster), 0.25f);
    ground.quad({-5, 0, -3.5f}, {0, 0, 7}, {10, 0, 0});
    stage.add("ground", std::move(ground));
    MeshBuilder boards = stage.builder(stage.material("boards", vec3(0.95f), 0.8f, plaster), 0.5f);
    MeshBuilder casters = stage.builder(stage.material("casters", {0.6f, 0.17f, 0.1f}, 0.5f));
    const float angles[] = {0, 20, 40, 55, 65, 75, 80, 85}; // of each board's normal to the sun
    for (int i = 0; i < 8; ++i) {
        // upright is 0 above the horizon; the normal looks to +Z, where the sun stands
        const mat4 place = at({-2.975f + 0.85f * float(i), 0, 0.6f}) * turned(angles[i] - sun_elevation, vec3(1, 0, 0));
        boards.transform = casters.transform = place;
        boards.box({0, 0.7f, -0.03f}, {0.36f, 0.7f, 0.03f});
        add_casters(casters);
    }
    stage.add("boards", std::move(boards));
    stage.add("casters", std::move(casters));
    stage.camera("front", {0, 2.5f, 5.3f}, {0, 0.55f, -0.1f}, 46);
    stage.camera("steep", {2.5f, 1.15f, 2.6f}, {2.2f, 0.7f, 0.5f}, 42);
    stage.sun("sun", sun_elevation, 0, 0.0f);
    stage.sun("soft sun", sun_elevation, 0, 1.5f);
    stage.spot("spot", {0, 7.5f, 1.0f}, {0, 0, 0.3f}, 62, 0.08f);
    stage.point("lamp", {0, 4.5f, 1.2f}, 0.08f);
    stage.rect("panel", {0, 6, 1.2f}, {0.6f, 0, 0}, {0, 0, 0.4f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
