// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"
#include "scene/generators/generators.h"
#include "scene/generators/noise.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

Scene balls(double detail)
{
    Stage stage("balls", detail);
    const int tiles = stage.texture(checker_tiles("floor tiles", {0.85f, 0.83f, 0.8f}, {0.74f, 0.72f, 0.7f}, 4, 17));
    MeshBuilder ground = stage.builder(stage.material("floor", vec3(0.85f), 0.75f, tiles), 0.5f);
    ground.quad({-15, 0, -15}, {0, 0, 30}, {30, 0, 0});
    stage.add("floor", std::move(ground));

    constexpr vec3 colors[] = {
        {0.72f, 0.16f, 0.1f}, {0.85f, 0.52f, 0.12f}, {0.15f, 0.42f, 0.3f}, {0.12f, 0.3f, 0.55f}, {0.8f, 0.78f, 0.74f}, {0.3f, 0.14f, 0.3f}};
    int meshes[std::size(colors)];
    for (size_t i = 0; i < std::size(colors); ++i) {
        MeshBuilder b = stage.builder(stage.material("ball " + std::to_string(i), colors[i], 0.35f + 0.1f * float(i % 3)));
        b.sphere(vec3(0), 1.0f, 32);
        meshes[i] = stage.mesh("ball " + std::to_string(i), std::move(b));
    }
    // A jittered hexagonal grid; heights grow in one direction, so that one picture has contact shadows and wide penumbrae.
    Random random(41);
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            const float radius = random.between(0.18f, 0.42f);
            const float x = 1.15f * (float(column) - 3.5f + 0.5f * float(row & 1)) + random.between(-0.15f, 0.15f);
            const float z = 1.05f * (float(row) - 3.5f) + random.between(-0.15f, 0.15f);
            const float lift = random.next() < 0.45f ? 0.0f : 2.4f * random.next() * (float(column) + 1.0f) / 8.0f;
            stage.place(meshes[size_t(random.below(int(std::size(colors))))], at({x, radius + lift, z}) * scaled(vec3(radius)));
        }
    }
    stage.camera("three-quarter", {3.4f, 3.0f, 6.8f}, {0.0f, 0.5f, 0.3f}, 48);
    stage.camera("low", {-6.2f, 0.9f, 4.6f}, {0, 0.7f, 0}, 45);
    stage.camera("from above", {0.5f, 11, 0.6f}, {0, 0, 0}, 50);
    stage.sun("sun", 48, -50, 0.0f, {1.0f, 0.94f, 0.84f});
    stage.sun("soft sun", 48, -50, 3.0f, {1.0f, 0.94f, 0.84f});
    stage.spot("spot", {-3.5f, 6, 4}, {0, 0, 0}, 70, 0.15f);
    stage.point("lamp", {0.5f, 4.2f, 0.5f}, 0.25f, {1.0f, 0.85f, 0.65f});
    stage.rect("panel", {0, 5, -2}, {1.5f, 0, 0}, {0, 0, 0.4f});
    stage.disk("dish", {-4, 4.5f, 2}, {0, 0.4f, 0}, 0.8f);
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
