// SPDX-License-Identifier: Apache-2.0
#include "scene/crop.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::scene {

namespace {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

bool finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::array<vec3, 8> corners(const Bounds& b)
{
    std::array<vec3, 8> result;
    for (size_t i = 0; i < 8; ++i) result[i] = vec3(i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z);
    return result;
}

void check(const Camera& c, Size size)
{
    if (size.width < 1 || size.height < 1)
        base::fail("a picture of {} x {} pixels has no pixels; give both sides at least 1", size.width, size.height);
    if (!finite(c.eye) || !finite(c.target) || !finite(c.up) || !std::isfinite(c.fov_y) || !std::isfinite(c.half_height)
        || !std::isfinite(c.near))
        base::fail("camera '{}' has a number that is not finite; state eye, target, up, fov and near anew", c.name);
    if (!(glm::length(dvec3(c.target) - dvec3(c.eye)) > 0.0))
        base::fail("camera '{}': eye and target are the same point; move one of them", c.name);
    if (c.half_height <= 0.0f && !(c.fov_y > 0.0f && c.fov_y < pi))
        base::fail("camera '{}': the vertical field of view is {} degrees, outside 0 to 180", c.name, glm::degrees(c.fov_y));
    if (c.near < 0.0f)
        base::fail("camera '{}': near is {} m; give a positive distance, or 0 for one chosen from the scene", c.name, c.near);
}

dmat4 look(const Camera& c)
{
    const dvec3 forward = glm::normalize(dvec3(c.target) - dvec3(c.eye));
    dvec3 up(c.up);
    // A camera that looks along its up vector (straight down on a plan) takes the axis farthest from its line of sight.
    if (glm::length(glm::cross(forward, up)) <= 1e-6 * glm::length(up) || glm::length(up) == 0.0)
        up = std::abs(forward.y) > 0.9 ? dvec3(0, 0, -1) : dvec3(0, 1, 0);
    return glm::lookAtRH(dvec3(c.eye), dvec3(c.eye) + forward, up);
}

/// A thousandth of the scene, but never beyond a fiftieth of the way to what the camera looks at (a macro shot in a large
/// scene), nor so near that an eye far outside loses its digits. Reversed float depth makes small values cheap.
float chosen_near(const Camera& c, const Bounds& bounds)
{
    const float distance = glm::length(c.target - c.eye);
    return std::clamp(1e-3f * bounds.radius(), 1e-5f * distance, 0.02f * distance);
}

/// Reversed depth with the far plane at infinity: depth = near / distance. Row y is negated: Vulkan's clip y points down.
dmat4 perspective(const Camera& c, double aspect, double near)
{
    const double f = 1.0 / std::tan(0.5 * double(c.fov_y));
    dmat4 m(0.0);
    m[0][0] = f / aspect;
    m[1][1] = -f;
    m[2][3] = -1.0;
    m[3][2] = near;
    return m;
}

/// Reversed linear depth over what of the bounds lies before the eye, with 1 % to spare at the far end so that nothing drawn has
/// depth 0, which means background.
dmat4 orthographic(const Camera& c, double aspect, const dmat4& view_from_world, const Bounds& bounds, double& near)
{
    double first = std::numeric_limits<double>::infinity(), last = -first;
    if (!bounds.empty()) {
        for (vec3 p : corners(bounds)) {
            const double d = -(view_from_world * dvec4(dvec3(p), 1.0)).z;
            first = std::min(first, d), last = std::max(last, d);
        }
    } else {
        first = 0.0, last = 2.0 * double(glm::length(c.target - c.eye));
    }
    const double margin = 0.01 * std::max(last - first, 1e-3);
    near = c.near > 0.0f ? double(c.near) : std::max(first - margin, 0.0);
    const double far = std::max(last, near) + margin;
    dmat4 m(1.0);
    m[0][0] = 1.0 / (double(c.half_height) * aspect);
    m[1][1] = -1.0 / double(c.half_height);
    m[2][2] = 1.0 / (far - near);
    m[3][2] = far / (far - near);
    return m;
}

/// Clip coordinates of the whole picture to those of a part of it.
dmat4 part_of(Size whole, const Crop& crop)
{
    dmat4 m(1.0);
    m[0][0] = double(whole.width) / crop.size.width, m[1][1] = double(whole.height) / crop.size.height;
    m[3][0] = double(whole.width - 2 * crop.left) / crop.size.width - 1.0;
    m[3][1] = double(whole.height - 2 * crop.top) / crop.size.height - 1.0;
    return m;
}

} // namespace

View make_view(const Camera& camera, Size size, const Bounds& scene_bounds, vec2 jitter, const Crop* crop)
{
    check(camera, size);
    const double aspect = double(size.width) / double(size.height);
    const dmat4 view_from_world = look(camera);
    View view;
    view.orthographic = camera.half_height > 0.0f;
    double near = camera.near > 0.0f ? double(camera.near) : double(chosen_near(camera, scene_bounds));
    dmat4 clip_from_view
        = view.orthographic ? orthographic(camera, aspect, view_from_world, scene_bounds, near) : perspective(camera, aspect, near);
    const double dx = 2.0 * double(jitter.x) / size.width, dy = 2.0 * double(jitter.y) / size.height;
    dmat4 shift(1.0);
    shift[3][0] = dx, shift[3][1] = dy;
    if (crop) shift = part_of(size, *crop) * shift;
    clip_from_view = shift * clip_from_view;
    const dmat4 clip_from_world = clip_from_view * view_from_world;

    view.view_from_world = mat4(view_from_world);
    view.clip_from_view = mat4(clip_from_view);
    view.clip_from_world = mat4(clip_from_world);
    view.world_from_clip = mat4(glm::inverse(clip_from_world));
    view.eye = camera.eye;
    view.near = float(near);
    view.size = crop ? crop->size : size;
    return view;
}

View make_view(const Camera& camera, Size size, const Bounds& scene_bounds, vec2 jitter)
{
    return make_view(camera, size, scene_bounds, jitter, nullptr);
}

Ray view_ray(const View& view, vec2 pixel)
{
    const dvec3 ndc(2.0 * double(pixel.x) / view.size.width - 1.0, 2.0 * double(pixel.y) / view.size.height - 1.0, 0.0);
    const mat4& p = view.clip_from_view;
    const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(glm::mat3(view.view_from_world)));
    if (view.orthographic) {
        const dvec3 p_view((ndc.x - double(p[3][0])) / double(p[0][0]), (ndc.y - double(p[3][1])) / double(p[1][1]), 0.0);
        return {vec3(dvec3(view.eye) + world_from_view * p_view), vec3(world_from_view * dvec3(0, 0, -1))};
    }
    // clip.w = -z, so at z = -1: ndc.x = p00 x - p20.
    const dvec3 d_view((ndc.x + double(p[2][0])) / double(p[0][0]), (ndc.y + double(p[2][1])) / double(p[1][1]), -1.0);
    return {view.eye, vec3(glm::normalize(world_from_view * d_view))};
}

Camera fit_camera(const Bounds& bounds)
{
    Camera camera;
    camera.name = "fit";
    if (bounds.empty()) return camera;
    constexpr float aspect = 1.5f; // narrower than most pictures, so that 16:9 has room to spare
    const vec3 back = glm::normalize(vec3(0.6f, 0.45f, 1.0f));
    const vec3 right = glm::normalize(glm::cross(vec3(0, 1, 0), back)), up = glm::cross(back, right);
    const float tangent = std::tan(0.5f * camera.fov_y);
    float distance = 0.0f;
    for (vec3 p : corners(bounds)) {
        const vec3 v = p - bounds.centre();
        const float across = std::max(std::abs(glm::dot(v, right)) / (aspect * tangent), std::abs(glm::dot(v, up)) / tangent);
        distance = std::max(distance, across + glm::dot(v, back));
    }
    camera.target = bounds.centre();
    camera.eye = camera.target + back * (distance > 0.0f ? 1.05f * distance : 1.0f);
    return camera;
}

} // namespace gnomon::scene
