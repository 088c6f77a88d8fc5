// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

#include <cmath>
#include <initializer_list>

/// Small scenes made by hand, so that the tests of truth depend on no generator and no file.
namespace truth_test {

using namespace gnomon;

inline scene::Mesh quad(vec3 a, vec3 b, vec3 c, vec3 d, int material = 0)
{
    scene::Mesh mesh;
    mesh.positions = {a, b, c, d};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.material = material;
    scene::complete(mesh);
    return mesh;
}

/// Level rectangle [x0, x1] x [z0, z1] at height y, front side up; uv = (0, 0) at (x0, z1).
inline scene::Mesh level_quad(float x0, float x1, float z0, float z1, float y, int material = 0)
{
    return quad({x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}, material);
}

/// Level regular polygon of `sides` with the area of a disk of `radius`.
inline scene::Mesh level_disk(float radius, float y, int sides, int material = 0)
{
    const double angle = 2.0 * std::numbers::pi / sides;
    const double r = double(radius) * std::sqrt(angle / std::sin(angle));
    scene::Mesh mesh;
    mesh.material = material;
    mesh.positions.push_back(vec3(0, y, 0));
    for (int i = 0; i < sides; ++i) {
        mesh.positions.emplace_back(float(r * std::cos(angle * i)), y, float(-r * std::sin(angle * i)));
        for (const int v : {0, i + 1, (i + 1) % sides + 1}) mesh.indices.push_back(uint32_t(v));
    }
    scene::complete(mesh);
    return mesh;
}

/// Rings x segments, front side out.
inline scene::Mesh sphere(vec3 centre, float radius, int rings, int segments, int material = 0)
{
    scene::Mesh mesh;
    mesh.material = material;
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s <= segments; ++s) {
            const double theta = std::numbers::pi * r / rings, phi = 2.0 * std::numbers::pi * s / segments;
            mesh.positions.push_back(centre
                + radius * vec3(float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)), float(std::sin(theta) * std::cos(phi))));
        }
    const auto row = uint32_t(segments + 1);
    for (uint32_t r = 0; r < uint32_t(rings); ++r)
        for (uint32_t s = 0; s < uint32_t(segments); ++s) {
            const uint32_t a = r * row + s, b = a + row;
            if (r > 0) mesh.indices.insert(mesh.indices.end(), {a, b, a + 1});
            if (r + 1 < uint32_t(rings)) mesh.indices.insert(mesh.indices.end(), {a + 1, b, b + 1});
        }
    scene::complete(mesh);
    return mesh;
}

/// Each mesh placed once; one opaque double-sided material, unless `materials` says otherwise.
inline scene::Scene scene_of(std::vector<scene::Mesh> meshes, std::vector<scene::Material> materials = {})
{
    scene::Scene s;
    s.name = "made by hand";
    if (materials.empty()) {
        materials.emplace_back();
        materials.back().double_sided = true;
    }
    s.materials = std::move(materials);
    s.meshes = std::move(meshes);
    for (size_t i = 0; i < s.meshes.size(); ++i) s.instances.push_back({int(i), mat4(1.0f)});
    return s;
}

inline scene::View look(const scene::Scene& s, vec3 eye, vec3 target, base::Size size = {64, 48}, float fov_degrees = 50.0f)
{
    scene::Camera c;
    c.eye = eye, c.target = target, c.fov_y = glm::radians(fov_degrees), c.near = 0.01f;
    return scene::make_view(c, size, s.bounds());
}

inline scene::Light light_of(scene::LightShape shape)
{
    scene::Light l;
    l.name = "test light";
    l.shape = shape;
    return l;
}

} // namespace truth_test
