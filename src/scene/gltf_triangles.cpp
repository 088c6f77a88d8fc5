// SPDX-License-Identifier: Apache-2.0
// Work on the arrays of a mesh, after the file has been read.
#include "scene/gltf_mesh.h"

#include <cmath>

namespace gnomon::scene::gltf {
namespace {

bool usable(vec3 p) { return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest; }

template <class T> void gather(std::vector<T>& values, const std::vector<uint32_t>& source)
{
    if (values.empty()) return;
    std::vector<T> out(source.size());
    for (size_t i = 0; i < out.size(); ++i) out[i] = values[source[i]];
    values = std::move(out);
}

/// Vertex i becomes what vertex source[i] was.
void gather_vertices(Mesh& mesh, const std::vector<uint32_t>& source)
{
    gather(mesh.positions, source);
    gather(mesh.normals, source);
    gather(mesh.uvs, source);
    gather(mesh.colors, source);
}

vec3 face_normal(const Mesh& mesh, size_t triangle)
{
    const uint32_t* i = &mesh.indices[triangle * 3];
    // In double, so that neither a scene of millimetres nor one of light years under- or overflows.
    const glm::dvec3 a(mesh.positions[i[0]]), b(mesh.positions[i[1]]), c(mesh.positions[i[2]]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    return length > 0 ? vec3(n / length) : vec3(0, 1, 0);
}

void make_flat_normals(Mesh& mesh)
{
    const std::vector<uint32_t> corners = std::move(mesh.indices);
    gather_vertices(mesh, corners);
    mesh.indices.resize(corners.size());
    mesh.normals.resize(corners.size());
    for (size_t i = 0; i < corners.size(); ++i) mesh.indices[i] = uint32_t(i);
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        mesh.normals[t * 3] = mesh.normals[t * 3 + 1] = mesh.normals[t * 3 + 2] = face_normal(mesh, t);
}

} // namespace

void to_triangle_list(uint64_t mode, std::vector<uint32_t>& indices)
{
    constexpr uint64_t strip = 5, fan = 6;
    if (mode != strip && mode != fan) {
        indices.resize(indices.size() / 3 * 3);
        return;
    }
    std::vector<uint32_t> out;
    const size_t triangles = indices.size() < 3 ? 0 : indices.size() - 2;
    out.reserve(triangles * 3);
    for (size_t i = 0; i < triangles; ++i) {
        const uint32_t a = indices[mode == fan ? 0 : i], b = indices[i + 1], c = indices[i + 2];
        const bool turned = mode == strip && i % 2 == 1; // every second triangle of a strip runs the other way round
        out.insert(out.end(), {a, turned ? c : b, turned ? b : c});
    }
    indices = std::move(out);
}

size_t drop_bad_triangles(Mesh& mesh)
{
    size_t kept = 0, dropped = 0;
    std::vector<uint32_t>& index = mesh.indices;
    for (size_t i = 0; i < index.size(); i += 3) {
        const uint32_t a = index[i], b = index[i + 1], c = index[i + 2];
        if (a == b || b == c || c == a) continue;
        if (!usable(mesh.positions[a]) || !usable(mesh.positions[b]) || !usable(mesh.positions[c])) {
            ++dropped;
            continue;
        }
        index[kept] = a, index[kept + 1] = b, index[kept + 2] = c;
        kept += 3;
    }
    index.resize(kept);
    return dropped;
}

void drop_unused_vertices(Mesh& mesh)
{
    constexpr uint32_t unused = ~0u;
    std::vector<uint32_t> renamed(mesh.positions.size(), unused);
    for (const uint32_t i : mesh.indices) renamed[i] = 0;
    std::vector<uint32_t> source;
    for (uint32_t i = 0; i < renamed.size(); ++i) {
        if (renamed[i] == unused) continue;
        renamed[i] = uint32_t(source.size());
        source.push_back(i);
    }
    if (source.size() == renamed.size()) return;
    gather_vertices(mesh, source);
    for (uint32_t& i : mesh.indices) i = renamed[i];
}

void finish_normals(Mesh& mesh)
{
    if (mesh.normals.empty()) return make_flat_normals(mesh);
    bool broken = false;
    for (vec3& n : mesh.normals) {
        const double length = glm::length(glm::dvec3(n));
        const bool good = length > 1e-6 && length <= double(farthest);
        n = good ? vec3(glm::dvec3(n) / length) : vec3(0);
        broken |= !good;
    }
    if (!broken) return;
    std::vector<vec3> given = std::move(mesh.normals);
    mesh.normals.clear();
    complete(mesh);
    for (size_t i = 0; i < given.size(); ++i)
        if (given[i] != vec3(0)) mesh.normals[i] = given[i];
}

void mirror_x(Mesh& mesh)
{
    for (vec3& p : mesh.positions) p.x = -p.x;
    for (vec3& n : mesh.normals) n.x = -n.x;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    mesh.bounds = {};
    complete(mesh);
}

} // namespace gnomon::scene::gltf
