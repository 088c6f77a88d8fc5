// SPDX-License-Identifier: Apache-2.0
#include "scene/analytic.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::scene::analytic {

namespace {

constexpr double pi_d = std::numbers::pi;

/// How far past the blocker the light's plane is, seen from p: a blocker point b projects to p + scale (b - p). 0 = the blocker is
/// not between the two.
double projection_scale(double p_y, double blocker_y, double light_y)
{
    const bool between = (blocker_y - p_y) * (light_y - blocker_y) > 0.0;
    return between ? (light_y - p_y) / (blocker_y - p_y) : 0.0;
}

struct Rect {
    double x, z, half_x, half_z;
};

Rect level_rect(const RectLight& l)
{
    const vec3 size = glm::abs(l.half_u) + glm::abs(l.half_v);
    const bool aligned = l.half_u.y == 0.0f && l.half_v.y == 0.0f && l.half_u.x * l.half_u.z == 0.0f && l.half_v.x * l.half_v.z == 0.0f;
    if (!aligned || !(size.x > 0.0f && size.z > 0.0f))
        base::fail("the closed forms need a level rectangle light with sides along x and z; turn the light or use sampled truth");
    return {l.centre.x, l.centre.z, size.x, size.z};
}

void check_level(const DiskLight& l)
{
    if (std::abs(l.normal.x) > 1e-6f || std::abs(l.normal.z) > 1e-6f || !(l.radius > 0.0f))
        base::fail("the closed forms need a level disk light; turn the light or use sampled truth");
}

bool emits_towards(const LightShape& shape, vec3 p)
{
    Light light;
    light.shape = shape;
    return reaches(light, p);
}

/// Length of the overlap of [a0, a1] and [b0, b1].
double overlap(double a0, double a1, double b0, double b1) { return std::max(0.0, std::min(a1, b1) - std::max(a0, b0)); }

/// Area of the part of the unit disk with x > s.
double segment_area(double s)
{
    if (s >= 1.0) return 0.0;
    if (s <= -1.0) return pi_d;
    return std::acos(s) - s * std::sqrt(1.0 - s * s);
}

/// Area common to two disks whose centres are d apart.
double lens_area(double d, double r0, double r1)
{
    if (d >= r0 + r1) return 0.0;
    if (d <= std::abs(r0 - r1)) return pi_d * std::min(r0, r1) * std::min(r0, r1);
    // The common chord is at x0 from centre 0 and x1 from centre 1; the lens is one segment of each disk.
    const double x0 = (d * d + r0 * r0 - r1 * r1) / (2.0 * d), x1 = d - x0;
    return r0 * r0 * segment_area(x0 / r0) + r1 * r1 * segment_area(x1 / r1);
}

} // namespace

double half_plane_visibility(const Light& light, vec3 p, double edge_x, double blocker_y)
{
    if (!reaches(light, p)) return 0.0;
    const auto edge_on_light = [&](double scale) { return double(p.x) + scale * (edge_x - double(p.x)); };
    if (const auto* rect = std::get_if<RectLight>(&light.shape)) {
        const Rect r = level_rect(*rect);
        const double scale = projection_scale(p.y, blocker_y, rect->centre.y);
        if (scale == 0.0) return 1.0;
        return std::clamp((r.x + r.half_x - edge_on_light(scale)) / (2.0 * r.half_x), 0.0, 1.0);
    }
    if (const auto* disk = std::get_if<DiskLight>(&light.shape)) {
        check_level(*disk);
        const double scale = projection_scale(p.y, blocker_y, disk->centre.y);
        if (scale == 0.0) return 1.0;
        return segment_area((edge_on_light(scale) - double(disk->centre.x)) / double(disk->radius)) / pi_d;
    }
    base::fail("half_plane has closed forms for rect and disk lights, not for a {} light", kind_name(light.kind()));
}

double rect_visibility(const RectLight& light, vec3 p, vec2 blocker_min, vec2 blocker_max, double blocker_y)
{
    const Rect r = level_rect(light);
    if (!emits_towards(light, p)) return 0.0;
    const double scale = projection_scale(p.y, blocker_y, light.centre.y);
    if (scale == 0.0) return 1.0;
    const auto project = [&](float p_axis, float b_axis) { return double(p_axis) + scale * (double(b_axis) - double(p_axis)); };
    const double x = overlap(project(p.x, blocker_min.x), project(p.x, blocker_max.x), r.x - r.half_x, r.x + r.half_x);
    const double z = overlap(project(p.z, blocker_min.y), project(p.z, blocker_max.y), r.z - r.half_z, r.z + r.half_z);
    return 1.0 - x * z / (4.0 * r.half_x * r.half_z);
}

double disk_visibility(const DiskLight& light, vec3 p, vec2 blocker_centre, double blocker_radius, double blocker_y)
{
    check_level(light);
    if (!emits_towards(light, p)) return 0.0;
    const double scale = projection_scale(p.y, blocker_y, light.centre.y);
    if (scale == 0.0) return 1.0;
    const double x = double(p.x) + scale * (double(blocker_centre.x) - double(p.x)) - double(light.centre.x);
    const double z = double(p.z) + scale * (double(blocker_centre.y) - double(p.z)) - double(light.centre.z);
    const double radius = light.radius;
    return 1.0 - lens_area(std::hypot(x, z), radius, scale * blocker_radius) / (pi_d * radius * radius);
}

} // namespace gnomon::scene::analytic
