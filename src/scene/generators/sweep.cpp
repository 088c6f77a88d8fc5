// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"

#include <array>

namespace gnomon::scene::generators {

namespace {

vec3 tangent_at(const std::vector<vec3>& path, size_t i)
{
    const vec3 before = path[i > 0 ? i - 1 : 0], after = path[std::min(i + 1, path.size() - 1)];
    return glm::normalize(after - before);
}

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

/// Ear clipping: triangles as index triples of a simple counter-clockwise polygon.
std::vector<std::array<int, 3>> triangulated(const std::vector<vec2>& polygon)
{
    std::vector<int> left(polygon.size());
    for (size_t i = 0; i < left.size(); ++i) left[i] = int(i);
    std::vector<std::array<int, 3>> result;
    const auto at_index = [&](int i) { return polygon[size_t(i)]; };
    const auto is_ear = [&](size_t i) {
        const int ia = left[(i + left.size() - 1) % left.size()], ib = left[i], ic = left[(i + 1) % left.size()];
        const vec2 a = at_index(ia), b = at_index(ib), c = at_index(ic);
        if (cross2(b - a, c - b) <= 0.0f) return false;
        for (int k : left) {
            const vec2 p = at_index(k);
            if (k == ia || k == ib || k == ic) continue;
            if (cross2(b - a, p - a) >= 0.0f && cross2(c - b, p - b) >= 0.0f && cross2(a - c, p - c) >= 0.0f) return false;
        }
        return true;
    };
    while (left.size() > 2) {
        size_t ear = 0;
        while (ear + 1 < left.size() && !is_ear(ear)) ++ear;
        result.push_back({left[(ear + left.size() - 1) % left.size()], left[ear], left[(ear + 1) % left.size()]});
        left.erase(left.begin() + long(ear));
    }
    return result;
}

} // namespace

void MeshBuilder::tube(const std::vector<vec3>& path, float radius, float radius_end, int around)
{
    // The frame is carried along by projection (parallel transport), which does not twist.
    const vec3 first = tangent_at(path, 0);
    vec3 side = glm::normalize(glm::cross(first, std::abs(first.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    struct Ring {
        vec3 centre, side, up;
        float radius, along;
    };
    std::vector<Ring> rings;
    float along = 0.0f;
    for (size_t i = 0; i < path.size(); ++i) {
        const vec3 t = tangent_at(path, i);
        side = glm::normalize(side - t * glm::dot(side, t));
        if (i > 0) along += glm::length(path[i] - path[i - 1]);
        rings.push_back({path[i], side, glm::cross(t, side), glm::mix(radius, radius_end, float(i) / float(path.size() - 1)), along});
    }
    const auto direction = [](const Ring& r, float u) { return r.side * std::cos(2.0f * pi * u) + r.up * std::sin(2.0f * pi * u); };
    for (size_t i = 0; i + 1 < rings.size(); ++i) {
        const Ring &a = rings[i], &b = rings[i + 1];
        const auto skin = [&](float u, float v) {
            const vec3 pa = a.centre + a.radius * direction(a, u), pb = b.centre + b.radius * direction(b, u);
            const vec3 n = glm::normalize(glm::mix(direction(a, u), direction(b, u), v));
            return Vertex{v >= 1.0f ? pb : glm::mix(pa, pb, v), n, vec2(2.0f * pi * u * radius, glm::mix(a.along, b.along, v))};
        };
        patch(around, 1, skin, true);
    }
    for (const Ring* r : {&rings.front(), &rings.back()}) {
        const vec3 n = r == &rings.front() ? -tangent_at(path, 0) : tangent_at(path, path.size() - 1);
        patch(
            around, 1,
            [&](float u, float v) {
                return Vertex{r->centre + v * r->radius * direction(*r, u), n, vec2(v * r->radius, 0)};
            },
            true);
    }
}

void MeshBuilder::sweep(const std::vector<vec3>& path, const std::vector<vec2>& profile, vec3 side)
{
    std::vector<mat3> frames; // side, up, tangent
    for (size_t i = 0; i < path.size(); ++i) {
        const vec3 t = tangent_at(path, i);
        const vec3 s = glm::normalize(side - t * glm::dot(side, t));
        frames.push_back(mat3(s, glm::cross(t, s), t));
    }
    const auto place = [&](size_t i, vec2 p) { return path[i] + frames[i][0] * p.x + frames[i][1] * p.y; };
    float along = 0.0f;
    for (size_t i = 0; i + 1 < path.size(); ++i) {
        const float length = glm::length(path[i + 1] - path[i]);
        float around = 0.0f;
        for (size_t k = 0; k < profile.size(); ++k) {
            const vec2 a = profile[k], b = profile[(k + 1) % profile.size()];
            const vec2 flat = glm::normalize(vec2(b.y - a.y, a.x - b.x));
            const vec3 n0 = frames[i][0] * flat.x + frames[i][1] * flat.y, n1 = frames[i + 1][0] * flat.x + frames[i + 1][1] * flat.y;
            patch(1, 1, [&](float u, float v) {
                const vec3 lower = glm::mix(place(i, a), place(i, b), u), upper = glm::mix(place(i + 1, a), place(i + 1, b), u);
                return Vertex{glm::mix(lower, upper, v), glm::normalize(glm::mix(n0, n1, v)),
                    vec2(around + u * glm::length(b - a), along + v * length)};
            });
            around += glm::length(b - a);
        }
        along += length;
    }
    for (size_t end : {size_t(0), path.size() - 1}) {
        for (const auto& t : triangulated(profile)) {
            vec3 a = place(end, profile[size_t(t[0])]), b = place(end, profile[size_t(t[1])]), c = place(end, profile[size_t(t[2])]);
            if (end == 0) std::swap(b, c);
            flat_triangle(a, b, c);
        }
    }
}

void MeshBuilder::extrude(const std::vector<vec2>& polygon, float depth)
{
    const float z = 0.5f * depth;
    for (const auto& t : triangulated(polygon)) {
        const vec2 a = polygon[size_t(t[0])], b = polygon[size_t(t[1])], c = polygon[size_t(t[2])];
        if (!(std::abs(cross2(b - a, c - a)) > 1e-12f)) continue;
        for (float side : {-1.0f, 1.0f}) {
            const int k = segments(1);
            const auto point = [&](int i, int j) {
                const vec2 p = (float(k - i - j) * a + float(i) * b + float(j) * c) * (1.0f / float(k));
                return add({vec3(p, side * z), vec3(0, 0, side), p});
            };
            for (int j = 0; j < k; ++j) {
                for (int i = 0; i < k - j; ++i) {
                    triangle(point(i, j), point(i + 1, j), point(i, j + 1));
                    if (i + j + 1 < k) triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
                }
            }
        }
    }
    const size_t count = polygon.size();
    const auto edge_normal = [&](size_t i) {
        const vec2 d = polygon[(i + 1) % count] - polygon[i % count];
        return glm::normalize(vec2(d.y, -d.x));
    };
    float along = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        const vec2 a = polygon[i], b = polygon[(i + 1) % count];
        const vec2 n = edge_normal(i), before = edge_normal(i + count - 1), after = edge_normal(i + 1);
        const vec2 na = glm::dot(n, before) > 0.766f ? glm::normalize(n + before) : n; // 40 degrees: as `lathe`
        const vec2 nb = glm::dot(n, after) > 0.766f ? glm::normalize(n + after) : n;
        const float length = glm::length(b - a);
        patch(1, 1, [&](float u, float v) {
            return Vertex{vec3(glm::mix(a, b, u), (2.0f * v - 1.0f) * z), vec3(glm::normalize(glm::mix(na, nb, u)), 0),
                vec2(along + u * length, v * depth)};
        });
        along += length;
    }
}

void MeshBuilder::height_field(vec2 min, vec2 max, int nx, int nz, const std::function<float(float, float)>& height)
{
    const float step = 0.25f * std::min((max.x - min.x) / float(nx), (max.y - min.y) / float(nz));
    patch(nx, nz, [&](float u, float v) {
        const float x = glm::mix(min.x, max.x, u), z = glm::mix(min.y, max.y, v);
        const float dx = height(x + step, z) - height(x - step, z), dz = height(x, z + step) - height(x, z - step);
        return Vertex{vec3(x, height(x, z), z), glm::normalize(vec3(-dx, 2.0f * step, -dz)), vec2(x, z)};
    });
}

} // namespace gnomon::scene::generators
