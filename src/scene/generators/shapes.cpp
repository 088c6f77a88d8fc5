// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"

#include <array>

namespace gnomon::scene::generators {

namespace {

constexpr float sharp_cosine = 0.766f; // 40 degrees

vec3 on_circle(float u)
{
    const float angle = 2.0f * pi * u;
    return vec3(std::cos(angle), 0.0f, -std::sin(angle));
}

/// A unit vector of a bevel, step i of k from face normal `a` to `b`. From integers, so that a corner's rim is its edges' to the bit.
vec3 between(vec3 a, vec3 b, int i, int k) { return glm::normalize(float(k - i) * a + float(i) * b); }

} // namespace

/// One corner of a bevelled box: the spherical triangle over three face normals, split as finely as the bevels' arcs so that they meet.
void MeshBuilder::face_corner(const vec3 (&d)[3], vec3 centre, vec3 inner, float bevel)
{
    const int k = segments(1);
    const auto point = [&](int i, int j) {
        const vec3 n = glm::normalize(float(k - i - j) * d[0] + float(i) * d[1] + float(j) * d[2]);
        return add({centre + (inner + bevel * n), n, vec2(inner.x + inner.z, inner.y)});
    };
    for (int j = 0; j < k; ++j) {
        for (int i = 0; i < k - j; ++i) {
            triangle(point(i, j), point(i + 1, j), point(i, j + 1));
            if (i + j + 1 < k) triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
    }
}

void MeshBuilder::box(vec3 centre, vec3 half, float bevel)
{
    bevel = std::clamp(bevel, 0.0f, 0.999f * std::min({half.x, half.y, half.z}));
    const vec3 core = half - bevel;
    const int steps = segments(1);
    const auto axis = [](int i, float sign) {
        vec3 v(0.0f);
        v[i] = sign;
        return v;
    };
    for (int i = 0; i < 3; ++i) {
        // Textures stand upright on the walls: v follows y there.
        const int iu = i == 0 ? 2 : 0, iv = i == 1 ? 2 : 1;
        for (float side : {-1.0f, 1.0f}) {
            const vec3 n = axis(i, side), u = axis(iu, core[iu]), v = axis(iv, core[iv]);
            patch(1, 1, [&](float s, float t) {
                const vec3 p = (side * axis(i, core[i]) + (2.0f * s - 1.0f) * u + (2.0f * t - 1.0f) * v) + bevel * n;
                return Vertex{centre + p, n, vec2(p[iu], p[iv])};
            });
            if (bevel <= 0.0f) continue;
            // The edge shared with the next axis' faces runs along the third.
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            for (float other : {-1.0f, 1.0f}) {
                const vec3 m = axis(j, other);
                patch(1, 1, [&](float s, float t) {
                    const vec3 d = between(n, m, int(std::lround(t * float(steps))), steps);
                    const vec3 p = side * axis(i, core[i]) + other * axis(j, core[j]) + (2.0f * s - 1.0f) * axis(k, core[k]);
                    return Vertex{centre + (p + bevel * d), d, vec2(p.x + p.z, p.y)};
                });
            }
        }
    }
    if (bevel <= 0.0f) return;
    for (int c = 0; c < 8; ++c) {
        const vec3 sign(c & 1 ? 1.0f : -1.0f, c & 2 ? 1.0f : -1.0f, c & 4 ? 1.0f : -1.0f);
        face_corner({vec3(sign.x, 0, 0), vec3(0, sign.y, 0), vec3(0, 0, sign.z)}, centre, sign * core, bevel);
    }
}

void MeshBuilder::hexahedron(const vec3 (&c)[8])
{
    constexpr std::array<std::array<int, 4>, 6> faces
        = {{{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    vec3 middle(0.0f);
    for (vec3 p : c) middle += 0.125f * p;
    for (const auto& f : faces) {
        const vec3 a = c[f[0]], b = c[f[1]], d = c[f[3]], e = c[f[2]];
        vec3 n = glm::normalize(glm::cross(e - a, d - b));
        if (glm::dot(n, 0.25f * (a + b + d + e) - middle) < 0.0f) n = -n;
        const vec2 size(0.5f * (glm::length(b - a) + glm::length(e - d)), 0.5f * (glm::length(d - a) + glm::length(e - b)));
        patch(1, 1, [&](float s, float t) { return Vertex{glm::mix(glm::mix(a, b, s), glm::mix(d, e, s), t), n, vec2(s, t) * size}; });
    }
}

void MeshBuilder::lathe(const std::vector<vec2>& profile, int around)
{
    const size_t parts = profile.size() - 1;
    std::vector<vec2> normal(parts);
    for (size_t i = 0; i < parts; ++i) {
        const vec2 d = profile[i + 1] - profile[i];
        normal[i] = glm::normalize(vec2(d.y, -d.x));
    }
    const bool closed = profile.front() == profile.back();
    const auto joined = [&](size_t i, size_t other) {
        return glm::dot(normal[i], normal[other]) > sharp_cosine ? glm::normalize(normal[i] + normal[other]) : normal[i];
    };
    float along = 0.0f;
    for (size_t i = 0; i < parts; ++i) {
        const vec2 a = profile[i], b = profile[i + 1];
        const vec2 na = i > 0 ? joined(i, i - 1) : closed ? joined(i, parts - 1) : normal[i];
        const vec2 nb = i + 1 < parts ? joined(i, i + 1) : closed ? joined(i, 0) : normal[i];
        const float length = glm::length(b - a), girth = 2.0f * pi * std::max(a.x, b.x);
        patch(
            around, 1,
            [&](float u, float v) {
                const vec3 d = on_circle(u);
                const vec2 p = v >= 1.0f ? b : glm::mix(a, b, v); // exact at the end, where the next part begins
                const vec2 n = glm::normalize(glm::mix(na, nb, v));
                return Vertex{d * p.x + vec3(0, p.y, 0), glm::normalize(d * n.x + vec3(0, n.y, 0)), vec2(u * girth, along + v * length)};
            },
            true);
        along += length;
    }
}

void MeshBuilder::cylinder(vec3 foot, float radius, float height, int around, float bevel)
{
    const mat4 saved = transform;
    transform = transform * at(foot);
    if (bevel > 0.0f)
        lathe({{0, 0}, {radius - bevel, 0}, {radius, bevel}, {radius, height - bevel}, {radius - bevel, height}, {0, height}}, around);
    else
        lathe({{0, 0}, {radius, 0}, {radius, height}, {0, height}}, around);
    transform = saved;
}

void MeshBuilder::cone(vec3 foot, float radius, float height, int around)
{
    const mat4 saved = transform;
    transform = transform * at(foot);
    lathe({{0, 0}, {radius, 0}, {0, height}}, around);
    transform = saved;
}

void MeshBuilder::sphere(vec3 centre, float radius, int around)
{
    patch(
        around, std::max(2, around / 2),
        [&](float u, float v) {
            const float latitude = pi * v;
            const float r = v <= 0.0f || v >= 1.0f ? 0.0f : std::sin(latitude); // sin(pi) is not 0 in float: the pole must be one point
            const vec3 n = on_circle(u) * r + vec3(0, -std::cos(latitude), 0);
            return Vertex{centre + radius * n, n, vec2(2.0f * pi * u, pi * v) * radius};
        },
        true);
}

void MeshBuilder::torus(vec3 centre, float radius, float tube, int around, int about)
{
    patch(
        around, about,
        [&](float u, float v) {
            const float a = v >= 1.0f ? 0.0f : 2.0f * pi * v; // ends where it began, to the bit
            const vec3 d = on_circle(u), n = d * std::cos(a) + vec3(0, std::sin(a), 0);
            return Vertex{centre + d * radius + tube * n, n, vec2(2.0f * pi * u * radius, 2.0f * pi * v * tube)};
        },
        true);
}

} // namespace gnomon::scene::generators
