// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/generators.h"
#include "scene/generators/masonry.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

/// Named after the case in which perspective warps of a shadow map gain nothing: the light shines towards the eye, so that what is
/// near for one is far for the other.
Scene duelling_frusta(double detail)
{
    Stage stage("duelling_frusta", detail);
    const int paving = stage.texture(stone_blocks("paving", {0.76f, 0.7f, 0.6f}, {0.56f, 0.5f, 0.42f}, 4, 4, 61, 0.02f));
    const int stone = stage.texture(mottled("stone", {0.8f, 0.72f, 0.6f}, 0.14f, 6, 62));
    MeshBuilder ground = stage.builder(stage.material("paving", vec3(0.85f), 0.8f, paving), 0.25f);
    ground.patch(40, 40, [](float u, float v) {
        const float x = 120.0f * (2.0f * u - 1.0f), z = 120.0f * (2.0f * v - 1.0f);
        return Vertex{{x, 0, z}, {0, 1, 0}, {x, z}};
    });
    stage.add("ground", std::move(ground));
    const int dressed = stage.material("stone", vec3(0.9f), 0.85f, stone);
    MeshBuilder pillar = stage.builder(dressed, 0.4f);
    pillar.box({0, 0.15f, 0}, {0.8f, 0.15f, 0.8f}, 0.04f);
    pillar.transform = at({0, 0.3f, 0});
    add_column(pillar, 0.42f, 5.0f, 20);
    const int pillar_mesh = stage.mesh("pillar", std::move(pillar));
    MeshBuilder beam = stage.builder(dressed, 0.4f);
    beam.box({0, 5.55f, 2.5f}, {0.5f, 0.25f, 2.48f}, 0.05f);
    beam.box({0, 5.9f, 2.5f}, {0.62f, 0.1f, 2.5f}, 0.03f);
    const int beam_mesh = stage.mesh("architrave", std::move(beam));
    constexpr int pairs = 22;
    for (int i = 0; i < pairs; ++i) {
        const float z = 10.0f - 5.0f * float(i);
        for (float side : {-1.0f, 1.0f}) {
            stage.place(pillar_mesh, at({side * 4.2f, 0, z}));
            // Some spans have fallen.
            if (i + 1 < pairs && (i * 7 + (side > 0.0f ? 3 : 0)) % 5 != 1) stage.place(beam_mesh, at({side * 4.2f, 0, z - 5.0f}));
        }
    }
    stage.camera("down the road", {1.1f, 1.7f, 17.5f}, {-0.2f, 2.3f, -10.0f}, 55);
    stage.camera("from above", {17.0f, 12.0f, 16.0f}, {0, 1.0f, -16.0f}, 45);
    stage.camera("along the light", {-3.0f, 5.5f, -104.0f}, {0.5f, 1.0f, -60.0f}, 50);
    stage.sun("sun", 20, 176, 0.0f, {1.0f, 0.86f, 0.66f});
    stage.sun("soft sun", 20, 176, 0.53f, {1.0f, 0.86f, 0.66f});
    stage.sun("side sun", 35, 110, 0.0f, {1.0f, 0.93f, 0.8f});
    stage.spot("spot", {0, 14, -45}, {0, 0, 0}, 50, 0.2f);
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
