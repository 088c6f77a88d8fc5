// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/clip.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

using Polygon = std::vector<vec3>;

/// Sutherland and Hodgman 1974: keeps the part with dot(plane, (p, 1)) >= 0.
Polygon clip(const Polygon& in, vec4 plane)
{
    Polygon out;
    for (size_t i = 0; i < in.size(); ++i) {
        const vec3 a = in[i], b = in[(i + 1) % in.size()];
        const float da = glm::dot(vec3(plane), a) + plane.w, db = glm::dot(vec3(plane), b) + plane.w;
        if (da >= 0.0f) out.push_back(a);
        if ((da >= 0.0f) != (db >= 0.0f)) out.push_back(a + (b - a) * (da / (da - db)));
    }
    return out;
}

/// The six faces of a hexahedron whose corner i has x high for i & 1, y for i & 2, z for i & 4.
std::array<Polygon, 6> faces(const std::array<vec3, 8>& c)
{
    return {Polygon{c[0], c[2], c[6], c[4]}, {c[1], c[3], c[7], c[5]}, {c[0], c[1], c[5], c[4]}, {c[2], c[3], c[7], c[6]},
        {c[0], c[1], c[3], c[2]}, {c[4], c[5], c[7], c[6]}};
}

std::array<vec3, 8> box_corners(const Bounds& b)
{
    std::array<vec3, 8> corners;
    for (int i = 0; i < 8; ++i) corners[size_t(i)] = vec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
    return corners;
}

/// Corners of the frustum, its far end just beyond the box (the view's own far plane is at infinity).
std::array<vec3, 8> frustum_corners(const scene::View& view, const Bounds& box)
{
    const vec3 forward = forward_of(view);
    float far = view.near;
    for (const vec3 c : box_corners(box)) far = std::max(far, glm::dot(c - view.eye, forward));
    far = far * 1.001f + 1e-3f;
    std::array<vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const scene::Ray ray = view_ray(view, vec2(i & 1 ? view.size.width : 0, i & 2 ? view.size.height : 0));
        const float along = glm::dot(ray.direction, forward), start = glm::dot(ray.origin - view.eye, forward);
        corners[size_t(i)] = ray.origin + ray.direction * (((i & 4 ? far : view.near) - start) / along);
    }
    return corners;
}

Planes box_planes(const Bounds& b)
{
    return {vec4(1, 0, 0, -b.min.x), vec4(-1, 0, 0, b.max.x), vec4(0, 1, 0, -b.min.y), vec4(0, -1, 0, b.max.y), vec4(0, 0, 1, -b.min.z),
        vec4(0, 0, -1, b.max.z)};
}

} // namespace

std::vector<vec3> visible_part(const scene::View& view, const Bounds& box)
{
    std::vector<vec3> points;
    const auto add = [&](const std::array<Polygon, 6>& polygons, const Planes& planes) {
        for (Polygon p : polygons) {
            for (const vec4& plane : planes) p = clip(p, plane);
            points.insert(points.end(), p.begin(), p.end());
        }
    };
    add(faces(box_corners(box)), frustum_planes(view.clip_from_world));
    add(faces(frustum_corners(view, box)), box_planes(box));
    return points;
}

vec3 forward_of(const scene::View& view)
{
    return -vec3(view.view_from_world[0][2], view.view_from_world[1][2], view.view_from_world[2][2]);
}

std::vector<vec3> visible_part(const scene::View& view, const Bounds& box, float from, float to)
{
    const vec3 forward = forward_of(view);
    const float eye = glm::dot(forward, view.eye);
    Planes planes = frustum_planes(view.clip_from_world);
    planes.push_back(vec4(forward, -eye - from));
    planes.push_back(vec4(-forward, eye + to));
    return vertices_within(planes, box);
}

std::vector<vec3> visible_part(const scene::View& view, const Bounds& box, const scene::SpotLight& spot, float near)
{
    Planes planes = frustum_planes(view.clip_from_world);
    const mat3 basis = scene::basis_about(spot.direction);
    const auto add = [&](vec3 normal, vec3 point) { planes.push_back(vec4(normal, -glm::dot(normal, point))); };
    add(spot.direction, spot.position + near * spot.direction);
    constexpr int sides = 16; // of a pyramid about the cone, wider than it by 2 % at its edges
    for (int i = 0; i < sides; ++i) {
        const float a = 2.0f * pi * float(i) / float(sides);
        const vec3 outward = std::cos(a) * basis[0] + std::sin(a) * basis[1];
        add(std::sin(spot.outer_angle) * spot.direction - std::cos(spot.outer_angle) * outward, spot.position);
    }
    return vertices_within(planes, box);
}

std::vector<vec3> vertices_within(const Planes& planes, const Bounds& box)
{
    const float slack = 1e-4f * std::max(box.radius(), 1e-3f), reach = 2.0f * box.radius() + slack;
    Planes sides = box_planes({box.min - slack, box.max + slack});
    sides.insert(sides.end(), planes.begin(), planes.end());
    std::vector<vec3> points;
    for (size_t i = 0; i < sides.size(); ++i) { // the face in each plane: a square about the box, cut by the others
        const vec3 n(sides[i]), foot = box.centre() - n * (glm::dot(n, box.centre()) + sides[i].w);
        const mat3 basis = scene::basis_about(n);
        Polygon p;
        for (const vec2 corner : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)})
            p.push_back(foot + reach * (corner.x * basis[0] + corner.y * basis[1]));
        for (size_t k = 0; k < sides.size(); ++k)
            if (k != i) p = clip(p, sides[k]);
        points.insert(points.end(), p.begin(), p.end());
    }
    return points;
}

} // namespace gnomon::shadow::parts
