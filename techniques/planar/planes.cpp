// SPDX-License-Identifier: Apache-2.0
#include "techniques/planar/planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace gnomon::techniques::planar {

namespace {

using glm::dvec3;
using glm::dvec4;

struct Triangle {
    std::array<dvec3, 3> p;
    dvec4 plane;
    double area;
};

double distance(const dvec4& plane, const dvec3& p) { return glm::dot(plane, dvec4(p, 1.0)); }

std::vector<Triangle> triangles_of(const scene::Scene& s)
{
    std::vector<Triangle> out;
    out.reserve(s.triangle_count());
    for (const scene::Instance& instance : s.instances) {
        const scene::Mesh& mesh = s.meshes[size_t(instance.mesh)];
        if (s.materials[size_t(mesh.material)].alpha == scene::AlphaMode::blend) continue;
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            Triangle t;
            // rounded to float as the device's world positions are, or a plane far from the origin would not hold its own triangles
            for (size_t k = 0; k < 3; ++k)
                t.p[k] = dvec3(vec3(instance.world_from_object * vec4(mesh.positions[mesh.indices[i + k]], 1.0f)));
            const dvec3 n = glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
            const double twice = glm::length(n);
            if (!(twice > 0.0)) continue;
            t.area = 0.5 * twice;
            t.plane = dvec4(n / twice, -glm::dot(n / twice, t.p[0]));
            out.push_back(t);
        }
    }
    return out;
}

/// Nearby planes fall into one cell; both orientations of one plane do, except where a normal's components nearly tie, which costs a
/// candidate and nothing else: candidates gather their triangles anew.
uint64_t cell_of(dvec4 plane, double offset_step)
{
    const dvec3 n(plane), a = glm::abs(n);
    const double major = a.x >= a.y && a.x >= a.z ? n.x : a.y >= a.z ? n.y : n.z;
    if (major < 0.0) plane = -plane;
    const auto bits = [](double v, int count) { return uint64_t(int64_t(std::llround(v))) & ((uint64_t(1) << count) - 1); };
    return bits(plane.x * 256.0, 12) | bits(plane.y * 256.0, 12) << 12 | bits(plane.z * 256.0, 12) << 24
        | bits(plane.w / offset_step, 28) << 36;
}

struct Candidate {
    double area = 0; ///< of its cell, then of the triangles on its plane that no chosen plane has
    size_t largest = 0;
    dvec4 plane{0};
    std::vector<uint32_t> members;
};

std::vector<uint32_t> triangles_near(const std::vector<Triangle>& triangles, const dvec4& plane, double off)
{
    std::vector<uint32_t> out;
    for (size_t i = 0; i < triangles.size(); ++i) {
        const auto& p = triangles[i].p;
        if (std::all_of(p.begin(), p.end(), [&](const dvec3& q) { return std::abs(distance(plane, q)) <= off; }))
            out.push_back(uint32_t(i));
    }
    return out;
}

/// The mean plane of some triangles that nearly share one: small triangles know their own to rounding over their size, and would miss what
/// lies far off.
dvec4 mean_plane(const std::vector<Triangle>& triangles, const std::vector<uint32_t>& members, const dvec4& first)
{
    dvec3 n(0), centre(0);
    double area = 0;
    for (const uint32_t i : members) {
        const Triangle& t = triangles[i];
        n += (glm::dot(dvec3(t.plane), dvec3(first)) < 0.0 ? -t.area : t.area) * dvec3(t.plane);
        centre += t.area / 3.0 * (t.p[0] + t.p[1] + t.p[2]);
        area += t.area;
    }
    n = glm::normalize(n);
    return dvec4(n, -glm::dot(n, centre / area));
}

/// Planes of the largest triangles of the cells with the most area: more of them than planes are wanted, since a plane between two cells
/// has part of its area in each.
std::vector<Candidate> candidates_of(const std::vector<Triangle>& triangles, double offset_step, size_t most)
{
    std::unordered_map<uint64_t, Candidate> cells;
    for (size_t i = 0; i < triangles.size(); ++i) {
        Candidate& c = cells[cell_of(triangles[i].plane, offset_step)];
        if (c.area == 0.0 || triangles[i].area > triangles[c.largest].area) c.largest = i;
        c.area += triangles[i].area;
    }
    std::vector<Candidate> out;
    for (auto& [cell, c] : cells) out.push_back(std::move(c));
    std::sort(out.begin(), out.end(),
        [](const Candidate& a, const Candidate& b) { return a.area != b.area ? a.area > b.area : a.largest < b.largest; });
    if (out.size() > most) out.resize(most);
    return out;
}

} // namespace

double plane_thickness(const scene::Scene& s)
{
    const Bounds b = s.bounds();
    if (b.empty()) return 0.0;
    return 3e-6 * double(glm::length(glm::max(glm::abs(b.min), glm::abs(b.max))));
}

std::vector<Plane> find_planes(const scene::Scene& s, int count, double smallest)
{
    const std::vector<Triangle> triangles = triangles_of(s);
    const double half = 0.5 * plane_thickness(s);
    double total = 0;
    for (const Triangle& t : triangles) total += t.area;
    std::vector<Candidate> candidates = candidates_of(triangles, std::max(2.0 * half, 1e-30), 6 * size_t(std::max(count, 1)));
    for (Candidate& c : candidates) {
        c.plane = triangles[c.largest].plane;
        c.plane = mean_plane(triangles, triangles_near(triangles, c.plane, 4.0 * half), c.plane);
        c.members = triangles_near(triangles, c.plane, half);
    }
    std::vector<bool> taken(triangles.size());
    std::vector<Plane> out;
    while (int(out.size()) < count && !candidates.empty()) {
        for (Candidate& c : candidates) {
            c.area = 0.0;
            for (const uint32_t i : c.members) c.area += taken[i] ? 0.0 : triangles[i].area;
        }
        const auto best = std::max_element(
            candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.area < b.area; });
        if (best->area <= 0.0 || best->area < smallest * total) break;
        out.push_back({best->plane, best->area});
        for (const uint32_t i : best->members) taken[i] = true;
    }
    return out;
}

} // namespace gnomon::techniques::planar
