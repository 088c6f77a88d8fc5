// SPDX-License-Identifier: Apache-2.0
#include "truth/rays.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace gnomon::truth {

using glm::dvec3;

PixelRays::PixelRays(const scene::View& view)
    : eye_(view.eye)
    , near_(view.near)
{
    const mat4& m = view.view_from_world;
    axis_ = glm::normalize(-dvec3(m[0][2], m[1][2], m[2][2]));
    const auto w = float(view.size.width), h = float(view.size.height);
    const scene::Ray corner[3] = {scene::view_ray(view, vec2(0, 0)), scene::view_ray(view, vec2(w, 0)), scene::view_ray(view, vec2(0, h))};
    for (int k = 0; k < 3; ++k) {
        origin_[k] = dvec3(corner[k].origin);
        direction_[k] = dvec3(corner[k].direction) / glm::dot(dvec3(corner[k].direction), axis_);
    }
    for (dvec3* values : {origin_, direction_}) {
        values[1] = (values[1] - values[0]) / double(w);
        values[2] = (values[2] - values[0]) / double(h);
    }
    near_ = std::max(0.0f, float(double(view.near) - glm::dot(axis_, origin_[0] - eye_)));
}

namespace {

float largest(vec3 v) { return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z))); }

} // namespace

Emitter::Emitter(const scene::Light& l)
    : light(l)
{
    if (const auto* rect = std::get_if<scene::RectLight>(&l.shape)) {
        normal = glm::normalize(glm::cross(rect->half_u, rect->half_v));
        extent = largest(glm::abs(rect->half_u) + glm::abs(rect->half_v)) * 2.0f;
    } else if (const auto* disk = std::get_if<scene::DiskLight>(&l.shape)) {
        normal = disk->normal;
        extent = 2.0f * disk->radius;
    } else {
        shorten = l.kind() != scene::LightKind::directional;
    }
    const vec4 sample = scene::light_point(l, vec3(0.125f, 0.25f, 0.375f), vec2(0.25f, 0.375f));
    const vec3 checked = glm::abs(vec3(sample)) + glm::abs(normal) + extent; // written so that NaN fails
    if (!(checked.x < 1e9f && checked.y < 1e9f && checked.z < 1e9f))
        base::fail("the light '{}' has a position, direction or size that is not finite or beyond 1e9 m; state its numbers anew", l.name);
}

Packet::Packet()
{
    for (int i = 0; i < lanes; ++i) {
        ray.org_x[i] = ray.org_y[i] = ray.org_z[i] = 0.0f;
        ray.dir_x[i] = ray.dir_y[i] = ray.dir_z[i] = 1.0f;
        ray.tnear[i] = ray.time[i] = ray.tfar[i] = 0.0f;
        ray.mask[i] = 0xffffffffu, ray.id[i] = unsigned(i), ray.flags[i] = 0;
        valid[i] = 0;
    }
}

void trace(const Geometry& geometry, Quantity quantity, Packet& packet, vec3 (&through)[lanes])
{
    Transmission t;
    rtcInitIntersectContext(&t.context);
    const bool colored = quantity == Quantity::transmittance;
    // In Embree 3.13 the coherent occlusion traversal goes through a packet octant by octant, but tests all of its rays at each leaf:
    // where rays converge on a light, the filter sees a crossing once an octant. That harms no yes or no, but it would square a pane.
    if (!colored) t.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    if (colored) std::fill(std::begin(t.product), std::end(t.product), vec3(1.0f));
    rtcOccluded8(packet.valid, colored ? geometry.all() : geometry.solid(), &t.context, &packet.ray);
    for (int i = 0; i < lanes; ++i) {
        if (!packet.valid[i]) continue;
        const bool hit = packet.ray.tfar[i] < 0.0f;
        through[i] = hit ? vec3(0.0f) : colored ? t.product[i] : vec3(1.0f);
    }
}

void aim_primary(const PixelRays& rays, base::Size size, int x0, int y0, RTCRayHit8& packet, int (&valid)[lanes])
{
    for (int i = 0; i < lanes; ++i) {
        const int x = x0 + i % packet_width, y = y0 + i / packet_width;
        const scene::Ray ray = rays.at(x, y);
        packet.ray.org_x[i] = ray.origin.x, packet.ray.org_y[i] = ray.origin.y, packet.ray.org_z[i] = ray.origin.z;
        packet.ray.dir_x[i] = ray.direction.x, packet.ray.dir_y[i] = ray.direction.y, packet.ray.dir_z[i] = ray.direction.z;
        packet.ray.tnear[i] = rays.near_parameter();
        packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
        packet.ray.time[i] = 0.0f, packet.ray.mask[i] = 0xffffffffu, packet.ray.id[i] = unsigned(i), packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = x < size.width && y < size.height ? -1 : 0;
    }
}

void Receivers::find(uint32_t primitive)
{
    const std::vector<uint32_t>& first = geometry_.first_primitives();
    const auto next = std::upper_bound(first.begin(), first.end(), primitive);
    end_ = next == first.end() ? no_primitive : *next;
    first_ = *(next - 1);
    extent_ = geometry_.extent(uint32_t(next - first.begin() - 1));
}

} // namespace gnomon::truth
