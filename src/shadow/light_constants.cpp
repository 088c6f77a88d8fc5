// SPDX-License-Identifier: Apache-2.0
#include "shadow/light_constants.h"

#include <cmath>

namespace gnomon::shadow {

shaders::View view_constants(const scene::View& view, uint32_t frame_index)
{
    shaders::View out{};
    out.clip_from_world = view.clip_from_world;
    out.world_from_clip = view.world_from_clip;
    out.eye = view.eye;
    out.near = view.near;
    // rows of view_from_world are the camera's axes in the world; it looks along -z
    out.forward = -vec3(view.view_from_world[0][2], view.view_from_world[1][2], view.view_from_world[2][2]);
    out.orthographic = view.orthographic ? 1 : 0;
    out.size = vec2(float(view.size.width), float(view.size.height));
    out.frame = frame_index;
    out.pixel_radius = 1.0f / (std::abs(view.clip_from_view[1][1]) * float(view.size.height));
    return out;
}

namespace {

template <class... F> struct Overload : F... {
    using F::operator()...;
};
template <class... F> Overload(F...) -> Overload<F...>;

} // namespace

float effective_intensity(const scene::Light& light, const Bounds& bounds)
{
    if (light.intensity) return *light.intensity;
    const vec3 centre = bounds.centre();
    const auto from_distance = [&](vec3 position) {
        // a light inside the scene is asked to fill a part of it, not to burn its very neighbour
        const float distance = std::max(glm::length(centre - position), 0.25f * bounds.radius());
        return pi * distance * distance;
    };
    return std::visit(
        Overload{[](const scene::DirectionalLight&) { return pi; }, [&](const scene::SpotLight& l) { return from_distance(l.position); },
            [&](const scene::PointLight& l) { return from_distance(l.position); },
            [&](const scene::RectLight& l) { return from_distance(l.centre); },
            [&](const scene::DiskLight& l) { return from_distance(l.centre); }},
        light.shape);
}

shaders::Light light_constants(const scene::Light& light, const Bounds& bounds)
{
    shaders::Light out{};
    out.kind = uint32_t(light.kind());
    out.radiance = light.color * effective_intensity(light, bounds);
    if (light.textured()) out.radiance *= light.image.tint;
    out.cos_inner = 1.0f, out.cos_outer = -1.0f;
    std::visit(Overload{[&](const scene::DirectionalLight& l) { out.direction = l.direction, out.radius = l.angular_radius; },
                   [&](const scene::SpotLight& l) {
                       out.position = l.position, out.direction = l.direction, out.radius = l.radius;
                       out.cos_inner = std::cos(std::min(l.inner_angle, l.outer_angle)), out.cos_outer = std::cos(l.outer_angle);
                   },
                   [&](const scene::PointLight& l) { out.position = l.position, out.radius = l.radius; },
                   [&](const scene::RectLight& l) {
                       out.position = l.centre, out.half_u = l.half_u, out.half_v = l.half_v;
                       out.direction = glm::normalize(glm::cross(l.half_u, l.half_v));
                       out.radius = std::sqrt(4.0f * glm::length(l.half_u) * glm::length(l.half_v) / pi); // disk of equal area
                   },
                   [&](const scene::DiskLight& l) {
                       out.position = l.centre, out.direction = l.normal, out.radius = l.radius;
                       const mat3 basis = scene::basis_about(l.normal);
                       out.half_u = l.radius * basis[0], out.half_v = l.radius * basis[1];
                   }},
        light.shape);
    return out;
}

} // namespace gnomon::shadow
