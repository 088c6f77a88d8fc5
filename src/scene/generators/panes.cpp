// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

Scene stacked_panes(double detail)
{
    Stage stage("stacked_panes", detail);
    const int plaster = stage.texture(mottled("plaster", {0.86f, 0.85f, 0.82f}, 0.07f, 6, 5));
    MeshBuilder ground = stage.builder(stage.material("floor", vec3(0.95f), 0.9f, plaster), 0.25f);
    ground.quad({-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    stage.add("floor", std::move(ground));

    struct Pane {
        const char* name;
        vec3 color;
        float alpha; ///< below 0: transmission instead
        vec3 centre;
        float turn;
    };
    const Pane panes[] = {
        {"ruby", {0.8f, 0.0f, 0.02f}, 0.6f, {-0.75f, 1.0f, 0.25f}, 8},
        {"amber", {0.95f, 0.45f, 0.0f}, 0.55f, {0.1f, 1.35f, 0.65f}, -12},
        {"emerald", {0.0f, 0.6f, 0.1f}, 0.6f, {0.75f, 1.7f, 0.1f}, 20},
        {"cobalt", {0.0f, 0.08f, 0.8f}, 0.6f, {0.0f, 2.05f, -0.55f}, -5},
        {"bottle glass", {0.72f, 0.95f, 0.8f}, -1.0f, {-0.35f, 2.4f, 0.1f}, 33},
    };
    for (const Pane& p : panes) {
        Material m;
        m.name = p.name;
        m.base_color = vec4(p.color, std::abs(p.alpha));
        m.roughness = 0.05f;
        m.double_sided = true;
        if (p.alpha >= 0.0f) {
            m.alpha = AlphaMode::blend;
        } else {
            m.transmission = 0.9f;
            m.thickness = 0.01f;
            m.attenuation_color = {0.6f, 0.9f, 0.7f};
            m.attenuation_distance = 0.02f;
        }
        // Sheets, so that one pane is one crossing.
        MeshBuilder b = stage.builder(stage.material(m));
        b.transform = at(p.centre) * turned(p.turn);
        b.quad({-0.7f, 0, -0.55f}, {0, 0, 1.1f}, {1.4f, 0, 0});
        stage.add(p.name, std::move(b));
    }
    MeshBuilder rods = stage.builder(stage.material("rods", {0.25f, 0.25f, 0.27f}, 0.4f));
    for (const Pane& p : panes) {
        for (int i = 0; i < 4; ++i) {
            rods.transform = at(p.centre) * turned(p.turn);
            const vec3 corner(i & 1 ? 0.7f : -0.7f, -p.centre.y, i & 2 ? 0.55f : -0.55f);
            rods.cylinder(corner, 0.012f, p.centre.y + 0.03f, 10);
        }
    }
    stage.add("rods", std::move(rods));
    stage.camera("three-quarter", {2.4f, 2.9f, 3.6f}, {-0.35f, 0.8f, -0.1f}, 50);
    stage.camera("floor", {0.6f, 3.6f, 3.4f}, {-0.9f, 0, -0.6f}, 45);
    stage.sun("sun", 58, 78, 0.0f);
    stage.sun("soft sun", 58, 78, 2.0f);
    stage.rect("panel", {0.5f, 5, 0.5f}, {0.5f, 0, 0}, {0, 0, 0.5f});
    stage.point("lamp", {1.0f, 4.5f, 0.8f}, 0.15f);
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
