// SPDX-License-Identifier: Apache-2.0
#include "host/space.h"

#include "host/result.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::host {

namespace {

using glm::dmat3;
using glm::dvec2;

double scale_of(const dmat4& world_from_host) { return glm::length(dvec3(world_from_host[0])); }
vec3 point(const dmat4& m, const float (&p)[3]) { return vec3(dvec3(m * dvec4(p[0], p[1], p[2], 1.0))); }
dvec3 vector(const dmat4& m, const float (&v)[3]) { return dmat3(m) * dvec3(v[0], v[1], v[2]); }

dmat4 finite_matrix(const float (&m)[16], const char* name)
{
    dmat4 out;
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(m[i])) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_frame::{} has a number that is not finite, element {}", name, i);
        out[i / 4][i % 4] = double(m[i]);
    }
    return out;
}

dvec4 row(const dmat4& m, int r) { return {m[0][r], m[1][r], m[2][r], m[3][r]}; }
dmat4 from_rows(const dvec4& x, const dvec4& y, const dvec4& z, const dvec4& w) { return glm::transpose(dmat4(x, y, z, w)); }

/// Where sample 0 lies in a pixel: Vulkan's standard sample locations.
dvec2 first_sample(VkSampleCountFlagBits samples)
{
    switch (samples) {
    case VK_SAMPLE_COUNT_2_BIT:
        return {0.75, 0.75};
    case VK_SAMPLE_COUNT_4_BIT:
        return {0.375, 0.125};
    case VK_SAMPLE_COUNT_8_BIT:
        return {0.5625, 0.3125};
    case VK_SAMPLE_COUNT_16_BIT:
        return {0.5625, 0.5625};
    default:
        return {0.5, 0.5};
    }
}

/// The plane's distance range over the corners of `bounds`.
std::pair<double, double> range_of(const Bounds& bounds, const dvec4& plane)
{
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int i = 0; i < 8; ++i) {
        const dvec4 p(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y, i & 4 ? bounds.max.z : bounds.min.z, 1.0);
        least = std::min(least, glm::dot(plane, p)), most = std::max(most, glm::dot(plane, p));
    }
    return {least, most};
}

/// The nearer of the distances at which the host's depth is 0 and 1; one of them may be infinite.
double near_of(const dmat4& world_from_clip, const dvec4& distance_row)
{
    double near = std::numeric_limits<double>::infinity();
    for (const double depth : {0.0, 1.0}) {
        const dvec4 p = world_from_clip * dvec4(0, 0, depth, 1);
        const double distance = glm::dot(distance_row, p) / p.w;
        if (std::isfinite(distance) && distance > 0.0) near = std::min(near, distance);
    }
    if (!std::isfinite(near))
        refuse(GNOMON_ERROR_ARGUMENT,
            "gnomon_frame::clip_from_view has no near plane before the eye; depth 0 or 1 must lie at a finite distance");
    return near;
}

/// Rows of the camera's axes (right, up, back) and its eye.
dmat4 view_from_world(const dvec3& right_row, const dvec3& down_row, const dvec3& forward, const dvec3& eye)
{
    const dvec3 right = glm::normalize(right_row - forward * glm::dot(forward, right_row));
    dvec3 up = -(down_row - forward * glm::dot(forward, down_row));
    up = glm::normalize(up - right * glm::dot(right, up));
    return from_rows(
        dvec4(right, -glm::dot(right, eye)), dvec4(up, -glm::dot(up, eye)), dvec4(-forward, glm::dot(forward, eye)), {0, 0, 0, 1});
}

} // namespace

dmat4 world_from_host(const gnomon_space& space, const dvec3& origin)
{
    if (space.up > 2) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_space::up is {}; it is 0 for x, 1 for y, 2 for z", space.up);
    const double metres = space.metres_per_unit == 0.0f ? 1.0 : double(space.metres_per_unit);
    if (!std::isfinite(metres) || metres <= 0.0)
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_space::metres_per_unit is {}; it is a positive number, or 0 for 1", metres);
    // right-handed turns that bring the up axis to +Y; a left-handed space has its last axis the other way round
    const dvec3 rows[3][3] = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    const auto& turn = rows[space.up];
    const double z = space.left_handed ? -1.0 : 1.0;
    const auto line = [&](const dvec3& v) { return dvec4(metres * v, -metres * glm::dot(v, origin)); };
    return from_rows(line(turn[0]), line(turn[1]), line(z * turn[2]), {0, 0, 0, 1});
}

dmat4 matrix_of(const VkTransformMatrixKHR& m)
{
    dmat4 out(1.0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) out[c][r] = double(m.matrix[r][c]);
    return out;
}

HostView view_of(const gnomon_frame& frame, const dmat4& world_from_host, base::Size size, const Bounds& bounds)
{
    dmat4 clip_from_world = finite_matrix(frame.clip_from_view, "clip_from_view") * finite_matrix(frame.view_from_world, "view_from_world")
        * glm::inverse(world_from_host);
    if (frame.y_up)
        clip_from_world = from_rows(row(clip_from_world, 0), -row(clip_from_world, 1), row(clip_from_world, 2), row(clip_from_world, 3));
    if (frame.depth.samples > VK_SAMPLE_COUNT_1_BIT) {
        // The view is moved by a part of a pixel, so that the sample lies where techniques look for a receiver: at the pixel's centre, the
        // same depth is before or behind its surface.
        const dvec2 off = 2.0 * (0.5 - first_sample(frame.depth.samples)) / dvec2(size.width, size.height);
        const dvec4 w = row(clip_from_world, 3);
        clip_from_world = from_rows(row(clip_from_world, 0) + off.x * w, row(clip_from_world, 1) + off.y * w, row(clip_from_world, 2), w);
    }
    const double determinant = glm::determinant(clip_from_world);
    if (!std::isfinite(determinant) || determinant == 0.0)
        refuse(GNOMON_ERROR_ARGUMENT,
            "gnomon_frame: clip_from_view times view_from_world has no inverse; give a projection that sees a volume");
    const dvec4 x = row(clip_from_world, 0), y = row(clip_from_world, 1), z = row(clip_from_world, 2);
    dvec4 w = row(clip_from_world, 3);
    HostView out{};
    scene::View& v = out.view;
    v.size = size;
    v.orthographic = glm::length(dvec3(w)) < 1e-9 * glm::length(dvec3(x)) * std::abs(w.w);
    dmat4 clip(1.0), view(1.0);
    if (v.orthographic) {
        const double sign = frame.background > 0.5f ? 1.0 : -1.0; // the host's depth grows with distance, or is reversed
        const double slope = glm::length(dvec3(z));
        const dvec3 forward = sign * dvec3(z) / slope;
        const auto [first, last] = range_of(bounds, dvec4(forward, 0.0));
        const double margin = 0.01 * std::max(last - first, 1e-3);
        // an eye anywhere before everything; the host's own near plane is nothing to shadows
        const dvec3 centre(bounds.centre());
        const dvec3 eye = centre + forward * (first - margin - glm::dot(forward, centre));
        const double length = last - first + 2.0 * margin;
        view = view_from_world(dvec3(x) / w.w, dvec3(y) / w.w, forward, eye);
        clip = from_rows(x / w.w, y / w.w, dvec4(-forward / length, 1.0 + glm::dot(forward, eye) / length), {0, 0, 0, 1});
        v.near = 0.0f, v.eye = vec3(eye);
    } else {
        // clip w is the distance along the view's axis, up to a scale; its sign is that before the eye
        w /= glm::length(dvec3(w));
        const double scale = 1.0 / glm::length(dvec3(row(clip_from_world, 3)));
        const dvec3 eye = glm::inverse(glm::transpose(dmat3(dvec3(x), dvec3(y), dvec3(w)))) * -dvec3(x.w, y.w, w.w);
        v.near = float(near_of(glm::inverse(clip_from_world), w));
        view = view_from_world(dvec3(x), dvec3(y), dvec3(w), eye);
        clip = from_rows(x * scale, y * scale, {0, 0, 0, double(v.near)}, w);
        v.eye = vec3(eye);
    }
    v.view_from_world = mat4(view);
    v.clip_from_view = mat4(clip * glm::inverse(view));
    v.clip_from_world = mat4(clip);
    v.world_from_clip = mat4(glm::inverse(clip));
    out.world_from_clip = glm::inverse(clip_from_world);
    const dmat4 ours_from_host = clip * out.world_from_clip;
    out.depth_row = row(ours_from_host, 2), out.w_row = row(ours_from_host, 3);
    for (dvec4* r : {&out.depth_row, &out.w_row}) r->w += r->z * double(frame.background);
    return out;
}

namespace {

dvec3 direction_of(const gnomon_light& light, const dmat4& m)
{
    const dvec3 d = vector(m, light.direction);
    if (!(glm::length(d) > 0.0) || !std::isfinite(glm::length(d)))
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light::direction is no direction; give a vector of any length but 0");
    return glm::normalize(d);
}

} // namespace

scene::Light light_of(const gnomon_light& light, const dmat4& m)
{
    for (const float number : {light.position[0], light.position[1], light.position[2], light.radius, light.inner_angle, light.outer_angle})
        if (!std::isfinite(number) || light.radius < 0.0f)
            refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light: position, radius and angles are finite numbers, and the radius is not negative");
    const float scale = float(scale_of(m));
    scene::Light out;
    switch (light.kind) {
    case GNOMON_DIRECTIONAL:
        out.shape = scene::DirectionalLight{vec3(direction_of(light, m)), light.radius};
        break;
    case GNOMON_SPOT:
        if (!(light.outer_angle > 0.0f && light.outer_angle < 0.5f * pi))
            refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light::outer_angle is {} radians; a spot's half angle lies between 0 and pi/2",
                light.outer_angle);
        out.shape = scene::SpotLight{
            point(m, light.position), vec3(direction_of(light, m)), light.inner_angle, light.outer_angle, light.radius * scale};
        break;
    case GNOMON_POINT:
        out.shape = scene::PointLight{point(m, light.position), light.radius * scale};
        break;
    case GNOMON_RECT: {
        const dvec3 u = vector(m, light.half_u), n = direction_of(light, m);
        dvec3 v = vector(m, light.half_v);
        const dvec3 normal = glm::cross(u, v);
        if (!(glm::length(normal) > 0.0))
            refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light: half_u and half_v of a rectangle span no area; give two sides that differ");
        if (glm::dot(normal, n) < 0.0) v = -v; // it emits to the side of cross(u, v)
        out.shape = scene::RectLight{point(m, light.position), vec3(u), vec3(v)};
        break;
    }
    case GNOMON_DISK:
        if (!(light.radius > 0.0f)) refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light::radius of a disk is 0; give it an area, or use a spot");
        out.shape = scene::DiskLight{point(m, light.position), vec3(direction_of(light, m)), light.radius * scale};
        break;
    default:
        refuse(GNOMON_ERROR_ARGUMENT, "gnomon_light::kind is {}; the kinds are 0 (directional) to 4 (disk)", light.kind);
    }
    out.intensity = 1.0f; // a visibility has no brightness
    return out;
}

} // namespace gnomon::host
