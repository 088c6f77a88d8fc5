// SPDX-License-Identifier: Apache-2.0
#include "scene/light.h"

#include <cmath>

namespace gnomon::scene {

namespace {

template <class... Ts> struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts> Overloaded(Ts...) -> Overloaded<Ts...>;

vec3 facing_disk_point(vec3 centre, float radius, vec3 receiver, vec2 u)
{
    const vec3 towards = receiver - centre;
    const float distance = glm::length(towards);
    if (radius <= 0.0f || distance <= 0.0f) return centre;
    return centre + radius * (basis_about(towards / distance) * vec3(square_to_disk(u), 0.0f));
}

} // namespace

vec2 square_to_disk(vec2 u)
{
    const vec2 a = 2.0f * u - 1.0f;
    if (a.x == 0.0f && a.y == 0.0f) return vec2(0.0f);
    const bool wide = std::abs(a.x) > std::abs(a.y);
    const float r = wide ? a.x : a.y;
    const float phi = wide ? 0.25f * pi * (a.y / a.x) : 0.5f * pi - 0.25f * pi * (a.x / a.y);
    return r * vec2(std::cos(phi), std::sin(phi));
}

mat3 basis_about(vec3 n)
{
    const float sign = n.z >= 0.0f ? 1.0f : -1.0f; // not the sign of -0, which a GPU may drop
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return mat3(vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n);
}

std::string_view kind_name(LightKind kind)
{
    constexpr std::string_view names[light_kind_count] = {"directional", "spot", "point", "rect", "disk"};
    return names[size_t(kind)];
}

bool Light::soft() const
{
    return std::visit(Overloaded{
                          [](const DirectionalLight& l) { return l.angular_radius > 0.0f; },
                          [](const SpotLight& l) { return l.radius > 0.0f; },
                          [](const PointLight& l) { return l.radius > 0.0f; },
                          [](const RectLight&) { return true; },
                          [](const DiskLight&) { return true; },
                      },
        shape);
}

vec4 light_point(const Light& light, vec3 p_world, vec2 u)
{
    return std::visit(
        Overloaded{
            [&](const DirectionalLight& l) {
                // Equal solid angle: 1 - cos(theta) = r^2 (1 - cos(alpha)). The half-angle form of 1 - cos keeps its
                // digits at the sun's alpha of 0.005, where 1 - cos in float has four left.
                const vec2 d = square_to_disk(u);
                const float s = std::sin(0.5f * l.angular_radius);
                const float k = 2.0f * s * s;
                const float z = k * glm::dot(d, d);
                return vec4(basis_about(-l.direction) * vec3(d * std::sqrt(k * (2.0f - z)), 1.0f - z), 0.0f);
            },
            [&](const SpotLight& l) { return vec4(facing_disk_point(l.position, l.radius, p_world, u), 1.0f); },
            [&](const PointLight& l) { return vec4(facing_disk_point(l.position, l.radius, p_world, u), 1.0f); },
            [&](const RectLight& l) { return vec4(l.centre + (2.0f * u.x - 1.0f) * l.half_u + (2.0f * u.y - 1.0f) * l.half_v, 1.0f); },
            [&](const DiskLight& l) { return vec4(l.centre + l.radius * (basis_about(l.normal) * vec3(square_to_disk(u), 0.0f)), 1.0f); },
        },
        light.shape);
}

bool reaches(const Light& light, vec3 p_world)
{
    return std::visit(Overloaded{
                          [](const DirectionalLight&) { return true; },
                          [&](const SpotLight& l) {
                              const vec3 v = p_world - l.position;
                              return glm::dot(v, l.direction) >= std::cos(l.outer_angle) * glm::length(v);
                          },
                          [](const PointLight&) { return true; },
                          [&](const RectLight& l) { return glm::dot(p_world - l.centre, glm::cross(l.half_u, l.half_v)) > 0.0f; },
                          [&](const DiskLight& l) { return glm::dot(p_world - l.centre, l.normal) > 0.0f; },
                      },
        light.shape);
}

} // namespace gnomon::scene
