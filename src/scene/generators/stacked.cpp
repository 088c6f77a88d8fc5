// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

constexpr float top = 3.2f, middle = 2.0f, low = 0.85f; ///< heights of the three layers

void add_ground(Stage& stage)
{
    const int plaster = stage.texture(mottled("plaster", {0.86f, 0.84f, 0.8f}, 0.07f, 6, 31));
    const int pale = stage.material("plaster", vec3(0.95f), 0.9f, plaster);
    MeshBuilder ground = stage.builder(pale, 0.25f);
    ground.quad({-6, 0, -6}, {0, 0, 12}, {12, 0, 0});
    stage.add("ground", std::move(ground));
    // The shadows of all layers run over its edge.
    MeshBuilder step = stage.builder(pale, 0.25f);
    step.box({-0.1f, 0.2f, -1.25f}, {2.2f, 0.2f, 1.15f});
    stage.add("step", std::move(step));
}

} // namespace

/// Under two casters the depths of a filter's kernel lie far apart, and a filter that keeps only moments of them takes part of the
/// lower one's shadow for light (Donnelly and Lauritzen 2006, section 6). The layers overlap in every combination.
Scene stacked(double detail)
{
    Stage stage("stacked", detail);
    add_ground(stage);
    MeshBuilder roof = stage.builder(stage.material("terracotta", {0.62f, 0.25f, 0.14f}, 0.8f));
    roof.box({-0.55f, top, -0.15f}, {1.1f, 0.015f, 1.25f});
    stage.add("roof", std::move(roof));
    MeshBuilder posts = stage.builder(stage.material("posts", {0.25f, 0.25f, 0.27f}, 0.5f));
    for (const vec3 foot : {vec3(-1.6f, 0.4f, -1.35f), vec3(0.5f, 0.4f, -1.35f), vec3(-1.6f, 0, 1.05f), vec3(0.5f, 0, 1.05f)})
        posts.cylinder(foot, 0.025f, top - foot.y, 12);
    stage.add("posts", std::move(posts));
    MeshBuilder slats = stage.builder(stage.material("slats", {0.55f, 0.38f, 0.2f}, 0.7f));
    for (int i = 0; i < 7; ++i) slats.box({0.05f + 0.3f * float(i), middle, 0.05f}, {0.085f, 0.012f, 1.15f});
    for (const float z : {-0.9f, 1.0f}) slats.box({0.95f, middle - 0.03f, z}, {1.05f, 0.012f, 0.04f});
    stage.add("slats", std::move(slats));
    MeshBuilder table = stage.builder(stage.material("enamel", {0.1f, 0.26f, 0.5f}, 0.4f));
    table.cylinder({0.1f, low, 0.35f}, 0.62f, 0.02f, 64);
    table.cylinder({0.1f, 0, 0.35f}, 0.03f, low, 16);
    stage.add("table", std::move(table));
    stage.camera("three-quarter", {2.5f, 2.9f, 4.5f}, {-0.15f, 0.75f, 0.0f}, 42);
    stage.camera("under", {1.7f, 1.7f, 2.5f}, {-0.5f, 0.1f, -0.3f}, 50);
    stage.sun("sun", 74, 60, 0.0f);
    stage.sun("soft sun", 74, 60, 1.5f);
    stage.spot("spot", {1.2f, 6.5f, 0.9f}, {0.2f, 0, 0}, 60, 0.1f);
    stage.point("lamp", {0.6f, 5.2f, 0.3f}, 0.1f);
    stage.rect("panel", {0.5f, 6, 0.3f}, {0.5f, 0, 0}, {0, 0, 0.5f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
