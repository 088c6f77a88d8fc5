// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "technique_fixture.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gnomon {

using gpu::floor_scene;

/// The same numbers on every platform, which std's distributions are not.
class Uniform {
public:
    explicit Uniform(uint32_t seed)
        : random_(seed)
    {
    }
    float operator()(float low, float high) { return low + (high - low) * float(random_() >> 8) * 0x1p-24f; }
    vec3 in_cube()
    {
        const float z = (*this)(-1, 1), y = (*this)(-1, 1), x = (*this)(-1, 1);
        return {x, y, z};
    }

private:
    std::mt19937 random_;
};

inline void add_mesh(scene::Scene& s, scene::Mesh m, const mat4& world_from_object = mat4(1))
{
    scene::complete(m);
    s.instances.push_back({int(s.meshes.size()), world_from_object});
    s.meshes.push_back(std::move(m));
}

/// A floor, and over it triangles of all sizes, each with corners of its own; some have no area.
inline scene::Scene soup(uint32_t seed, int triangles)
{
    scene::Scene s = floor_scene(4);
    Uniform uniform(seed);
    scene::Mesh m;
    for (int t = 0; t < triangles; ++t) {
        const float z = uniform(-3, 3), y = uniform(0.2f, 3), x = uniform(-3, 3);
        const float size = 0.05f + 1.5f * std::pow(uniform(0, 1), 4.0f);
        for (int k = 0; k < 3; ++k) {
            m.indices.push_back(uint32_t(m.positions.size()));
            m.positions.push_back(vec3(x, y, z) + size * uniform.in_cube());
        }
        if (t % 16 == 0)
            m.positions.back() = t % 32 ? m.positions[m.positions.size() - 2]
                                        : 0.5f * (m.positions[m.positions.size() - 2] + m.positions[m.positions.size() - 3]);
    }
    add_mesh(s, std::move(m));
    return s;
}

/// A box of unit half widths about the origin, its corners shared, seen from outside only where its material is single-sided.
inline scene::Mesh box()
{
    scene::Mesh m;
    for (int k = 0; k < 8; ++k) m.positions.push_back({k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1});
    m.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return m;
}

/// A closed surface about the origin, star-shaped with radii of 0.7 to 1, where every triangle has corners of its own in an order of its
/// own: neighbours share nothing but the bits of their positions. Its triangles go to two meshes by turns.
inline std::array<scene::Mesh, 2> closed_shape(uint32_t seed, int rings = 10, int sectors = 18)
{
    Uniform uniform(seed);
    std::vector<vec3> points;
    for (int r = 0; r <= rings; ++r)
        for (int k = 0; k < sectors; ++k) {
            const float polar = pi * float(r) / float(rings), around = 2 * pi * float(k) / float(sectors), radius = uniform(0.7f, 1);
            points.push_back(radius * vec3(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around)));
        }
    const auto at = [&](int r, int k) { return points[size_t(r == 0 || r == rings ? r * sectors : r * sectors + k % sectors)]; };
    std::array<scene::Mesh, 2> out;
    size_t count = 0;
    const auto add = [&](std::array<vec3, 3> t) {
        scene::Mesh& m = out[count++ % 2];
        const auto turn = size_t(uniform(0, 3));
        for (size_t k = 0; k < 3; ++k) {
            m.indices.push_back(uint32_t(m.positions.size()));
            m.positions.push_back(t[(k + turn) % 3]);
        }
    };
    for (int r = 0; r < rings; ++r)
        for (int k = 0; k < sectors; ++k) {
            if (r > 0) add({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
            if (r + 1 < rings) add({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
        }
    return out;
}

/// What is drawn, and how much of it the truth must be able to tell.
struct ExactCase {
    std::string name;
    scene::Scene scene;
    scene::Camera camera;
    std::string light;
    double scale = 1; ///< of the scene, in scenes of a few metres
    double most_unknown = 0.5; ///< of all pixels
};

inline const scene::Camera oblique{.eye = {4, 4, 6}, .target = {0, 0.5f, 0}};

/// Cameras and lights in the places where techniques fail (exact_suite_test.cpp).
std::vector<ExactCase> special_places();
/// Triangles that no modeller should have made, whose shadow is defined all the same.
std::vector<ExactCase> bad_triangles();
/// Cameras and lights within and without closed shapes: not one ray gets through.
std::vector<ExactCase> closed_shapes();
/// Coordinates at which single precision has no digits left: any answer is right, but it must be one.
std::vector<ExactCase> lost_precision();

} // namespace gnomon
