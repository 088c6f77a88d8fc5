// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/foliage.h"
#include "scene/generators/generators.h"
#include "scene/generators/textures.h"

namespace gnomon::scene::generators {

namespace {

float ground_height(float x, float z)
{
    const vec2 p = vec2(x, z) * 0.07f + 20.0f;
    return 2.2f * (fractal_noise(p, 64, 3, 71) - 0.5f) + 0.0035f * x * x - 0.02f * z;
}

int masked(Stage& stage, std::string name, int texture, float cutoff)
{
    const int m = stage.material(std::move(name), vec3(0.9f), 0.75f, texture);
    stage.edit(m).alpha = AlphaMode::mask;
    stage.edit(m).alpha_cutoff = cutoff;
    stage.edit(m).double_sided = true;
    return m;
}

struct TreeMeshes {
    int wood, leaves;
    void place(Stage& stage, const mat4& m) const { stage.place(wood, m), stage.place(leaves, m); }
};

TreeMeshes add_tree(Stage& stage, const std::string& name, const TreeShape& shape, int bark, int leaf, float card, int per_twig)
{
    MeshBuilder wood = stage.builder(bark, 0.7f);
    // More, smaller cards with more detail; the leaves' area stays the same.
    const float fine = stage.fineness();
    const auto twigs = grow_tree(wood, shape, std::max(1, int(std::lround(float(per_twig) * fine * fine))));
    vec3 crown(0);
    for (const Twig& t : twigs) crown += t.foot / float(twigs.size());
    crown.y -= 0.25f * shape.trunk;
    MeshBuilder cards = stage.builder(leaf);
    Random random(shape.seed + 1);
    for (const Twig& t : twigs) add_leaf_card(cards, t, card / fine * random.between(0.75f, 1.2f), crown, random);
    return {stage.mesh(name + " wood", std::move(wood)), stage.mesh(name + " leaves", std::move(cards))};
}

} // namespace

Scene tree(double detail)
{
    Stage stage("tree", detail);
    const int turf = stage.texture(mottled("turf", {0.47f, 0.48f, 0.3f}, 0.35f, 12, 72));
    const int bark_texture = stage.texture(planks("bark", {0.42f, 0.34f, 0.27f}, 6, 73));
    const int spray = stage.texture(leaf_spray("oak leaves", {0.5f, 0.6f, 0.28f}, 74));
    const int blades = stage.texture(grass_blades("grass blades", {0.58f, 0.62f, 0.34f}, 75));
    MeshBuilder ground = stage.builder(stage.material("turf", vec3(0.75f), 0.95f, turf), 0.25f);
    ground.height_field({-30, -40}, {30, 20}, 40, 40, ground_height);
    stage.add("ground", std::move(ground));

    const int bark = stage.material("bark", vec3(0.7f), 0.95f, bark_texture);
    const int leaf = masked(stage, "leaves", spray, 0.5f);
    const TreeShape oak{.seed = 9, .trunk = 3.6f, .radius = 0.27f, .levels = 3, .branches = 8, .spread = 64, .reach = 0.78f, .lift = 0.3f};
    const TreeShape birch{
        .seed = 26, .trunk = 5.6f, .radius = 0.12f, .levels = 2, .branches = 9, .spread = 48, .reach = 0.42f, .lift = 0.1f};
    const TreeMeshes oak_meshes = add_tree(stage, "oak", oak, bark, leaf, 0.85f, 11);
    const TreeMeshes birch_meshes = add_tree(stage, "birch", birch, bark, leaf, 0.62f, 8);
    const auto stand = [](float x, float z) { return at({x, ground_height(x, z), z}); };
    oak_meshes.place(stage, stand(-1.2f, -1.5f));
    birch_meshes.place(stage, stand(-8.5f, -6.0f) * turned(40));
    birch_meshes.place(stage, stand(7.6f, -9.5f) * turned(280) * scaled(vec3(1.1f)));

    MeshBuilder tufts = stage.builder(masked(stage, "grass", blades, 0.4f));
    Random random(76);
    add_grass(tufts, int(std::lround(55.0 * detail)), 2.2f, 0.3f, random);
    const int tuft_mesh = stage.mesh("grass", std::move(tufts));
    for (int i = 0; i < 26; ++i) {
        const float x = random.between(-9, 8), z = random.between(-7, 8);
        stage.place(tuft_mesh, stand(x, z) * turned(360.0f * random.next()));
    }
    MeshBuilder rocks = stage.builder(stage.material("rock", {0.36f, 0.34f, 0.31f}, 0.9f));
    add_rock(rocks, {0.6f, 0.4f, 0.45f}, 18, 77);
    const int rock_mesh = stage.mesh("rock", std::move(rocks));
    stage.place(rock_mesh, stand(1.9f, 1.6f));
    stage.place(rock_mesh, stand(2.7f, 1.1f) * turned(110) * scaled(vec3(0.55f)));
    stage.camera("meadow", {3.0f, 1.7f, 9.2f}, {0.3f, 3.1f, -2.0f}, 52);
    stage.camera("under the crown", {-3.6f, 0.75f, 2.9f}, {-0.9f, 2.9f, -2.2f}, 64);
    stage.camera("from above", {9.0f, 9.5f, 9.0f}, {-1.0f, 1.6f, -3.0f}, 48);
    stage.sun("sun", 40, -62, 0.0f, {1.0f, 0.93f, 0.8f});
    stage.sun("soft sun", 40, -62, 0.53f, {1.0f, 0.93f, 0.8f});
    stage.sun("evening sun", 14, -120, 0.53f, {1.0f, 0.75f, 0.5f});
    return std::move(stage).finish();
}

} // namespace gnomon::scene::generators
