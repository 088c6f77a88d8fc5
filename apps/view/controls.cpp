// SPDX-License-Identifier: Apache-2.0
#include "controls.h"

#include <algorithm>
#include <cmath>

namespace gnomon::view {

namespace {

struct Axes {
    vec3 right, up, forward;
};

Axes axes_of(const scene::Camera& camera)
{
    Axes a;
    a.forward = glm::normalize(camera.target - camera.eye);
    vec3 right = glm::cross(a.forward, camera.up);
    if (!(glm::length(right) > 1e-6f)) right = glm::cross(a.forward, std::abs(a.forward.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1));
    a.right = glm::normalize(right);
    a.up = glm::cross(a.right, a.forward);
    return a;
}

/// Turns about `up`, then tilts, and stops five degrees before the poles, where right and left would change places.
vec3 turned(vec3 direction, vec3 up, vec2 turn)
{
    constexpr float pole = glm::radians(85.0f);
    up = glm::normalize(up);
    const float length = glm::length(direction);
    vec3 d = direction / length;
    const float elevation = std::asin(std::clamp(glm::dot(d, up), -1.0f, 1.0f));
    const float wanted = std::clamp(elevation + turn.y, std::min(-pole, elevation), std::max(pole, elevation));
    vec3 level = d - glm::dot(d, up) * up;
    if (!(glm::length(level) > 1e-6f)) level = glm::cross(up, std::abs(up.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 0, 1));
    level = glm::angleAxis(turn.x, up) * glm::normalize(level);
    return length * (std::cos(wanted) * level + std::sin(wanted) * up);
}

/// Metres across the view that a pixel spans at this distance.
float metres_per_pixel(const scene::Camera& camera, float distance, float picture_height)
{
    const float half = camera.half_height > 0.0f ? camera.half_height : std::abs(distance) * std::tan(0.5f * camera.fov_y);
    return 2.0f * half / std::max(picture_height, 1.0f);
}

void move(vec3& position, const scene::Camera& camera, vec2 pixels, float picture_height, bool along)
{
    const Axes a = axes_of(camera);
    const float reach = std::max(glm::dot(position - camera.eye, a.forward), 0.1f * glm::length(camera.target - camera.eye));
    const float step = metres_per_pixel(camera, reach, picture_height);
    position += along ? -pixels.y * step * a.forward : step * (pixels.x * a.right - pixels.y * a.up);
}

} // namespace

scene::Camera orbit(scene::Camera camera, vec2 turn)
{
    camera.eye = camera.target + turned(camera.eye - camera.target, camera.up, {-turn.x, turn.y});
    return camera;
}

scene::Camera look(scene::Camera camera, vec2 turn)
{
    camera.target = camera.eye + turned(camera.target - camera.eye, camera.up, {-turn.x, -turn.y});
    return camera;
}

scene::Camera slide(scene::Camera camera, vec2 pixels, float picture_height)
{
    const Axes a = axes_of(camera);
    const float step = metres_per_pixel(camera, glm::length(camera.target - camera.eye), picture_height);
    const vec3 by = step * (-pixels.x * a.right + pixels.y * a.up);
    camera.eye += by, camera.target += by;
    return camera;
}

scene::Camera approach(scene::Camera camera, float steps)
{
    const float factor = std::pow(0.9f, std::clamp(steps, -20.0f, 20.0f));
    if (camera.half_height > 0.0f) {
        camera.half_height = std::clamp(camera.half_height * factor, 1e-6f, 1e6f);
        return camera;
    }
    const vec3 away = (camera.eye - camera.target) * factor;
    if (glm::length(away) > 1e-4f) camera.eye = camera.target + away;
    return camera;
}

scene::Camera fly(scene::Camera camera, vec3 metres)
{
    const Axes a = axes_of(camera);
    const vec3 by = metres.x * a.right + metres.y * glm::normalize(camera.up) + metres.z * a.forward;
    camera.eye += by, camera.target += by;
    return camera;
}

scene::Light drag_light(scene::Light light, const scene::Camera& camera, vec2 pixels, float picture_height, bool along)
{
    if (auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
        const vec2 turn = pixels * (pi / std::max(picture_height, 1.0f));
        sun->direction = -glm::normalize(turned(-sun->direction, vec3(0, 1, 0), {turn.x, -turn.y}));
    } else if (auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
        move(spot->position, camera, pixels, picture_height, along);
    } else if (auto* point = std::get_if<scene::PointLight>(&light.shape)) {
        move(point->position, camera, pixels, picture_height, along);
    } else if (auto* rect = std::get_if<scene::RectLight>(&light.shape)) {
        move(rect->centre, camera, pixels, picture_height, along);
    } else {
        move(std::get<scene::DiskLight>(light.shape).centre, camera, pixels, picture_height, along);
    }
    return light;
}

scene::Light resize_light(scene::Light light, float pixels, float unit)
{
    // about linear below `small`, so that 0 is left and found again
    const auto resized
        = [&](float size, float small, float most) { return std::clamp((size + small) * std::exp(0.01f * pixels) - small, 0.0f, most); };
    const float most = 1000.0f * unit, least = 0.1f * unit; // panels have an area
    if (auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
        sun->angular_radius = resized(sun->angular_radius, glm::radians(0.1f), glm::radians(15.0f));
    } else if (auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
        spot->radius = resized(spot->radius, unit, most);
    } else if (auto* point = std::get_if<scene::PointLight>(&light.shape)) {
        point->radius = resized(point->radius, unit, most);
    } else if (auto* disk = std::get_if<scene::DiskLight>(&light.shape)) {
        disk->radius = std::max(resized(disk->radius, unit, most), least);
    } else {
        auto& rect = std::get<scene::RectLight>(light.shape);
        const float length = std::max(glm::length(rect.half_u), glm::length(rect.half_v));
        const float scale = std::max(resized(length, unit, most), least) / length;
        rect.half_u *= scale, rect.half_v *= scale;
    }
    return light;
}

} // namespace gnomon::view
