// SPDX-License-Identifier: Apache-2.0
#include "scene/generators/builder.h"

namespace gnomon::scene::generators {

namespace {

uint32_t packed(vec3 color)
{
    const auto byte = [](float v) { return uint32_t(std::lround(std::clamp(v, 0.0f, 1.0f) * 255.0f)); };
    return byte(color.x) | byte(color.y) << 8 | byte(color.z) << 16 | 0xff000000u;
}

} // namespace

uint32_t MeshBuilder::add(const Vertex& v)
{
    const auto index = uint32_t(mesh_.positions.size());
    mesh_.positions.push_back(vec3(transform * vec4(v.p, 1.0f)));
    // Normals by the cofactors, which are the inverse transpose up to scale.
    const mat3 m(transform);
    const mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const float sign = glm::determinant(m) < 0.0f ? -1.0f : 1.0f;
    mesh_.normals.push_back(glm::normalize(sign * (cofactors * v.n)));
    mesh_.uvs.push_back(v.uv * uv_ + uv_offset);
    mesh_.colors.push_back(packed(tint));
    tinted_ = tinted_ || tint != vec3(1.0f);
    return index;
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c)
{
    const auto& p = mesh_.positions;
    const auto& n = mesh_.normals;
    if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
    if (glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), n[a] + n[b] + n[c]) < 0.0f) std::swap(b, c);
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
}

void MeshBuilder::patch(int nu, int nv, const Surface& surface, bool closed_u)
{
    nu = segments(nu), nv = segments(nv);
    const auto first = uint32_t(mesh_.positions.size());
    for (int j = 0; j <= nv; ++j) {
        for (int i = 0; i <= nu; ++i) {
            const float u = float(i) / float(nu), v = float(j) / float(nv);
            Vertex vertex = surface(u, v);
            if (closed_u && i == nu) {
                const Vertex start = surface(0.0f, v);
                vertex.p = start.p, vertex.n = start.n;
            }
            add(vertex);
        }
    }
    const auto row = uint32_t(nu + 1);
    for (uint32_t j = 0; j < uint32_t(nv); ++j) {
        for (uint32_t i = 0; i < uint32_t(nu); ++i) {
            const uint32_t a = first + j * row + i;
            triangle(a, a + 1, a + row + 1);
            triangle(a, a + row + 1, a + row);
        }
    }
}

void MeshBuilder::quad(vec3 a, vec3 u, vec3 v)
{
    const vec3 n = glm::normalize(glm::cross(u, v));
    const vec2 size(glm::length(u), glm::length(v));
    patch(1, 1, [&](float s, float t) { return Vertex{a + s * u + t * v, n, vec2(s, t) * size}; });
}

void MeshBuilder::flat_triangle(vec3 a, vec3 b, vec3 c)
{
    const vec3 n = glm::normalize(glm::cross(b - a, c - a));
    const vec3 s = glm::normalize(b - a), t = glm::cross(n, s);
    const int k = segments(1);
    // Row j holds k - j + 1 points. Each is a sum over the corners, so that neighbours split a shared edge alike.
    const auto point = [&](int i, int j) {
        const float scale = 1.0f / float(k);
        const vec3 p = (float(k - i - j) * a + float(i) * b + float(j) * c) * scale;
        return add({p, n, vec2(glm::dot(p - a, s), glm::dot(p - a, t))});
    };
    for (int j = 0; j < k; ++j) {
        for (int i = 0; i < k - j; ++i) {
            const uint32_t corner[3] = {point(i, j), point(i + 1, j), point(i, j + 1)};
            triangle(corner[0], corner[1], corner[2]);
            if (i + j + 1 < k) triangle(corner[1], point(i + 1, j + 1), corner[2]);
        }
    }
}

Mesh MeshBuilder::finish(std::string name) &&
{
    mesh_.name = std::move(name);
    if (!tinted_) mesh_.colors.clear();
    complete(mesh_);
    return std::move(mesh_);
}

std::vector<vec2> arc(vec2 centre, float radius, float from, float to, int count)
{
    std::vector<vec2> points;
    for (int i = 0; i < count; ++i) {
        const float a = glm::radians(glm::mix(from, to, float(i) / float(count - 1)));
        points.push_back(centre + radius * vec2(std::cos(a), std::sin(a)));
    }
    return points;
}

mat4 at(vec3 p) { return glm::translate(mat4(1.0f), p); }
mat4 turned(float degrees, vec3 axis) { return glm::rotate(mat4(1.0f), glm::radians(degrees), axis); }
mat4 scaled(vec3 s) { return glm::scale(mat4(1.0f), s); }

} // namespace gnomon::scene::generators
