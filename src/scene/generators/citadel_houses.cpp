// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/citadel_parts.h"
#include "scene/generators/foliage.h"

namespace gnomon::scene::generators::citadel_parts {

namespace {

/// A beam between two points in the plane of a wall (z constant).
void add_brace(MeshBuilder& b, vec2 from, vec2 to, float width, float z)
{
    const vec2 along = glm::normalize(to - from) * 0.5f * width;
    const vec2 side(-along.y, along.x);
    const float half = 0.06f;
    b.hexahedron({vec3(from - side, z - half), vec3(from + side, z - half), vec3(to - side, z - half), vec3(to + side, z - half),
        vec3(from - side, z + half), vec3(from + side, z + half), vec3(to - side, z + half), vec3(to + side, z + half)});
}

struct House {
    float w, d, ground, upper, roof; ///< plan, storey heights, roof height
};

/// Timber frame of the upper storey on a wall of width w: posts, rails and braces.
void add_frame(MeshBuilder& wood, float w, float bottom, float top, int panels)
{
    const float half = 0.5f * w;
    for (float y : {bottom, 0.5f * (bottom + top), top}) wood.box({0, y, 0}, {half, 0.09f, 0.07f});
    for (int i = 0; i <= panels; ++i)
        wood.box({w * float(i) / float(panels) - half, 0.5f * (bottom + top), 0}, {0.09f, 0.5f * (top - bottom), 0.075f});
    const float step = w / float(panels);
    add_brace(wood, {-half, 0.5f * (bottom + top)}, {-half + step, bottom}, 0.14f, 0);
    add_brace(wood, {half, 0.5f * (bottom + top)}, {half - step, bottom}, 0.14f, 0);
    add_brace(wood, {-half, 0.5f * (bottom + top)}, {-half + step, top}, 0.14f, 0);
    add_brace(wood, {half, 0.5f * (bottom + top)}, {half - step, top}, 0.14f, 0);
}

struct Builders {
    MeshBuilder stone, plaster, wood, roof, dark, trim;
    void set(const mat4& m) { stone.transform = plaster.transform = wood.transform = roof.transform = dark.transform = trim.transform = m; }
};

void add_house(Builders& b, const mat4& base, const House& h, int panels)
{
    const float hw = 0.5f * h.w, hd = 0.5f * h.d, jetty = 0.35f, eaves = h.ground + h.upper;
    b.set(base);
    b.stone.box({0, 0.5f * h.ground, 0}, {hw, 0.5f * h.ground, hd});
    b.plaster.box({0, h.ground + 0.5f * h.upper, 0.5f * jetty}, {hw + 0.05f, 0.5f * h.upper, hd + 0.5f * jetty});
    // Gables: the attic's triangular ends.
    const float gable = h.d * 0.5f + 0.5f * jetty;
    b.plaster.transform = base * at({0, 0, 0.5f * jetty}) * turned(90);
    b.plaster.extrude({{-gable, eaves}, {gable, eaves}, {0, eaves + h.roof}}, h.w + 0.1f);
    for (float side : {0.0f, 1.0f}) {
        b.wood.transform = base * at({0, 0, 0.5f * jetty}) * turned(side > 0 ? 180.0f : 0.0f) * at({0, 0, hd + 0.5f * jetty});
        add_frame(b.wood, h.w + 0.1f, h.ground + 0.05f, eaves - 0.1f, panels);
        b.wood.transform = base * at({0, 0, 0.5f * jetty}) * turned(side > 0 ? 90.0f : -90.0f) * at({0, 0, hw + 0.05f});
        add_frame(b.wood, 2.0f * gable, h.ground + 0.05f, eaves - 0.1f, std::max(2, panels - 2));
        add_brace(b.wood, {0, eaves}, {0, eaves + h.roof - 0.1f}, 0.16f, 0);
        add_brace(b.wood, {-0.55f * gable, eaves}, {-0.05f, eaves + 0.75f * h.roof}, 0.13f, 0);
        add_brace(b.wood, {0.55f * gable, eaves}, {0.05f, eaves + 0.75f * h.roof}, 0.13f, 0);
    }
    b.wood.transform = base;
    for (int i = 0; i < 9; ++i)
        b.wood.box({(float(i) - 4.0f) * (h.w / 8.4f), h.ground - 0.1f, hd + 0.15f}, {0.08f, 0.09f, 0.3f}); // jetty joists
    for (int i = 0; i < panels; i += 2) { // windows with open shutters
        const float x = h.w * (float(i) + 0.5f) / float(panels) - hw, y = h.ground + 0.62f * h.upper, z = hd + jetty + 0.02f;
        b.dark.box({x, y, z}, {0.3f, 0.4f, 0.03f});
        b.trim.box({x, y - 0.45f, z + 0.06f}, {0.42f, 0.05f, 0.12f}, 0.02f);
        for (float s : {-1.0f, 1.0f}) {
            b.wood.transform = base * at({x + s * 0.32f, y, z + 0.03f}) * turned(-s * 25.0f);
            b.wood.box({s * 0.16f, 0, 0}, {0.16f, 0.42f, 0.02f});
        }
        b.wood.transform = base;
        b.wood.box({x, y, z + 0.03f}, {0.02f, 0.4f, 0.02f});
    }
    b.wood.box({-0.25f * h.w, 1.0f, hd + 0.02f}, {0.5f, 1.0f, 0.06f}, 0.02f);
    b.dark.box({0.2f * h.w, 1.45f, hd + 0.01f}, {0.45f, 0.4f, 0.03f});
    b.trim.box({0.2f * h.w, 1.0f, hd + 0.06f}, {0.6f, 0.06f, 0.14f}, 0.02f);
    b.trim.box({-0.25f * h.w, 0.08f, hd + 0.3f}, {0.7f, 0.08f, 0.3f}, 0.03f);
    b.roof.transform = base * at({0, eaves - 0.12f, 0.5f * jetty});
    add_gable_roof(b.roof, h.w + 0.9f, 2.0f * gable + 0.8f, h.roof + 0.35f, 0.14f);
    b.stone.transform = base * at({0.28f * h.w, 0, -0.3f * h.d});
    b.stone.box({0, 0.5f * (eaves + h.roof) + 0.9f, 0}, {0.38f, 0.5f * (eaves + h.roof) + 0.9f, 0.38f});
    b.trim.transform = b.stone.transform;
    b.trim.box({0, eaves + h.roof + 1.85f, 0}, {0.46f, 0.09f, 0.46f}, 0.03f);
}

} // namespace

void add_gable_roof(MeshBuilder& b, float w, float d, float height, float thickness)
{
    const float hw = 0.5f * w, hd = 0.5f * d;
    for (float s : {-1.0f, 1.0f}) {
        const vec3 up = glm::normalize(vec3(0, hd, s * height)) * thickness;
        const vec3 e0(-hw, 0, s * hd), e1(hw, 0, s * hd), r0(-hw, height, 0), r1(hw, height, 0);
        b.hexahedron({e0, e1, r0, r1, e0 + up, e1 + up, r0 + vec3(0, up.y, 0), r1 + vec3(0, up.y, 0)});
    }
    b.box({0, height + thickness, 0}, {hw + 0.02f, 0.09f, 0.14f}, 0.05f);
}

void add_houses(Stage& stage, const Materials& m)
{
    Builders b{stage.builder(m.dark_stone, 0.4f), stage.builder(m.plaster, 0.3f), stage.builder(m.timber, 0.8f),
        stage.builder(m.roof, 0.4f), stage.builder(m.dark), stage.builder(m.dressed, 0.5f)};
    add_house(b, at({9.5f, 0, -11.6f}), {8.4f, 5.4f, 2.7f, 2.6f, 2.9f}, 6);
    add_house(b, at({-13.6f, 0, 1.8f}) * turned(90), {7.4f, 5.2f, 2.6f, 2.5f, 2.8f}, 5);
    b.set(at({-14.4f, 0, 9.6f})); // lean-to stable
    for (float x : {-1.9f, 1.9f})
        for (float z : {-2.3f, 0.0f, 2.3f})
            b.wood.box({x, 1.3f + (x < 0 ? 0.5f : 0.0f), z}, {0.1f, 1.3f + (x < 0 ? 0.5f : 0.0f), 0.1f}, 0.02f);
    b.roof.hexahedron({{-2.4f, 3.65f, -3}, {2.5f, 2.45f, -3}, {-2.4f, 3.77f, -3}, {2.5f, 2.57f, -3}, {-2.4f, 3.65f, 3}, {2.5f, 2.45f, 3},
        {-2.4f, 3.77f, 3}, {2.5f, 2.57f, 3}});
    b.wood.box({1.9f, 0.95f, -1.2f}, {0.05f, 0.06f, 1.1f}, 0.01f);
    b.wood.box({1.9f, 0.5f, -1.2f}, {0.05f, 0.06f, 1.1f}, 0.01f);
    stage.add("house stone", std::move(b.stone));
    stage.add("house plaster", std::move(b.plaster));
    stage.add("house timber", std::move(b.wood));
    stage.add("house roofs", std::move(b.roof));
    stage.add("house windows", std::move(b.dark));
    stage.add("house trim", std::move(b.trim));
    MeshBuilder hay = stage.builder(m.hay, 0.8f);
    Random random(83);
    for (int i = 0; i < 7; ++i) {
        hay.transform = at({-14.8f + 0.9f * float(i % 3) + 0.3f * random.next(), 0.28f + (i > 4 ? 0.55f : 0.0f),
                            8.4f + 1.1f * float((i * 2) % 4) + 0.2f * random.next()})
            * turned(40.0f * random.next());
        hay.box(vec3(0), {0.55f, 0.27f, 0.4f}, 0.09f);
    }
    stage.add("hay", std::move(hay));
}

} // namespace gnomon::scene::generators::citadel_parts
