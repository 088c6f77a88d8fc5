// SPDX-License-Identifier: Apache-2.0
#include "lab/motion.h"

#include "base/error.h"
#include "base/names.h"
#include "scene/option_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::lab {

namespace {

constexpr float longest_step = 1e6f; // metres
constexpr float widest_turn = 90.0f; // degrees

using Kind = Motion::Kind;

/// The keys of a step's components, in their order.
struct Keys {
    std::vector<std::string> shift, turn;
};
const Keys& keys_of(Kind kind)
{
    static const Keys camera{{"right", "up", "forward"}, {"turn", "tilt"}}, light{{"x", "y", "z"}, {"azimuth", "elevation"}}, none;
    return kind == Kind::camera ? camera : kind == Kind::light ? light : none;
}

const std::vector<std::string> kind_names = {"still", "camera", "light", "time"};

/// Sets the component of a step that has this key, if any.
template <class Step>
bool set_component(std::optional<Step>& step, const std::vector<std::string>& keys, const scene::OptionPlace& place,
    const std::string& value, float limit, const char* unit)
{
    for (size_t i = 0; i < keys.size(); ++i) {
        if (keys[i] != place.key) continue;
        if (!step) step = Step(0.0f);
        (*step)[int(i)] = scene::option_number(place, value, -limit, limit, unit);
        return true;
    }
    return false;
}

int frame_count(const scene::OptionPlace& place, const std::string& value)
{
    const float count = scene::option_number(place, value, 3, float(most_frames), "frames");
    if (count != std::floor(count)) base::fail("motion '{}': frames is {}, which is no whole number", place.text, value);
    return int(count);
}

template <class Step> void append(std::string& out, const std::optional<Step>& step, const std::vector<std::string>& keys)
{
    for (size_t i = 0; step && i < keys.size(); ++i)
        if (const float value = (*step)[int(i)]; value != 0.0f) out += fmt::format(",{}={:.6g}", keys[i], value);
}

bool is_sun(const scene::Light& light) { return light.kind() == scene::LightKind::directional; }

} // namespace

Motion parse_motion(const std::string& text)
{
    const scene::OptionText options = scene::split_options(text);
    Motion out;
    const auto kind = std::find(kind_names.begin(), kind_names.end(), options.name);
    if (options.name.empty()) base::fail("motion '{}' begins with no kind; begin with still, camera, light or time", text);
    if (kind == kind_names.end()) base::fail("motion '{}': {}", text, base::unknown_name("kind", options.name, kind_names));
    out.kind = Kind(kind - kind_names.begin());
    const Keys& keys = keys_of(out.kind);
    for (const auto& [key, value] : options.pairs) {
        const scene::OptionPlace place{"motion", text, key};
        if (key == "frames")
            out.frames = frame_count(place, value);
        else if (out.kind == Kind::time && key == "step")
            out.step = double(scene::option_number(place, value, 1e-6f, 1e6f, "s"));
        else if (!set_component(out.shift, keys.shift, place, value, longest_step, "m")
            && !set_component(out.turn, keys.turn, place, value, widest_turn, "degrees")) {
            std::vector<std::string> all = keys.shift;
            all.insert(all.end(), keys.turn.begin(), keys.turn.end());
            if (out.kind == Kind::time) all.push_back("step");
            all.push_back("frames");
            scene::unknown_key(place, all);
        }
    }
    if (out.kind == Kind::light && out.shift && out.turn)
        base::fail("motion '{}': a sun turns by azimuth and elevation, other lights move by x, y and z; give one of the two", text);
    return out;
}

std::string motion_text(const Motion& motion)
{
    std::string out = kind_names[size_t(motion.kind)];
    append(out, motion.shift, keys_of(motion.kind).shift);
    append(out, motion.turn, keys_of(motion.kind).turn);
    if (motion.step) out += fmt::format(",step={:.6g}", *motion.step);
    return out + fmt::format(",frames={}", motion.frames);
}

Motion with_steps(Motion motion, const scene::Light& light, float pixel, float scene_radius)
{
    const bool given = motion.shift || motion.turn;
    switch (motion.kind) {
    case Kind::still:
        break;
    case Kind::camera:
        if (!given) motion.shift = vec3(2 * pixel, 0, 0);
        break;
    case Kind::light:
        if (motion.turn && !is_sun(light))
            base::fail("motion '{}': azimuth and elevation turn suns; this light is a {}, which moves by x, y and z", motion_text(motion),
                scene::kind_name(light.kind()));
        if (motion.shift && is_sun(light))
            base::fail("motion '{}': x, y and z move lights that stand somewhere; this one is a sun, which turns by azimuth and elevation",
                motion_text(motion));
        if (!given && is_sun(light)) motion.turn = vec2(0.5f, 0);
        if (!given && !is_sun(light)) motion.shift = vec3(0.01f * scene_radius, 0, 0);
        break;
    case Kind::time:
        if (!motion.step) motion.step = 1.0 / 30.0;
        break;
    }
    return motion;
}

scene::Camera moved(const scene::Camera& camera, const Motion& motion, int index)
{
    if (motion.kind != Kind::camera || index == 0) return camera;
    const mat3 world_from_view = glm::transpose(mat3(scene::make_view(camera, {1, 1}, {}).view_from_world));
    const vec3 right = world_from_view[0], up = world_from_view[1], forward = -world_from_view[2];
    const float n = float(index);
    scene::Camera out = camera;
    const vec3 way = motion.shift.value_or(vec3(0)), step = n * (way.x * right + way.y * up + way.z * forward);
    const vec2 angles = glm::radians(n * motion.turn.value_or(vec2(0)));
    const vec3 ahead = glm::rotate(mat4(1), -angles.x, up) * glm::rotate(mat4(1), angles.y, right) * vec4(forward, 0);
    out.eye += step;
    out.target = out.eye + glm::length(camera.target - camera.eye) * ahead;
    // what the camera turns about, so that no frame rolls against the one before
    out.up = glm::rotate(mat4(1), -angles.x, up) * glm::rotate(mat4(1), angles.y, right) * vec4(up, 0);
    return out;
}

scene::Light moved(const scene::Light& light, const Motion& motion, int index)
{
    if (motion.kind != Kind::light || index == 0) return light;
    const vec3 step = float(index) * motion.shift.value_or(vec3(0));
    const vec2 angles = glm::radians(float(index) * motion.turn.value_or(vec2(0)));
    scene::Light out = light;
    if (auto* sun = std::get_if<scene::DirectionalLight>(&out.shape)) {
        const vec3 d = -sun->direction; // towards the sun
        const float elevation = std::asin(std::clamp(d.y, -1.0f, 1.0f)) + angles.y, azimuth = std::atan2(d.x, d.z) + angles.x;
        sun->direction = -vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth));
    } else if (auto* spot = std::get_if<scene::SpotLight>(&out.shape))
        spot->position += step;
    else if (auto* point = std::get_if<scene::PointLight>(&out.shape))
        point->position += step;
    else if (auto* rect = std::get_if<scene::RectLight>(&out.shape))
        rect->centre += step;
    else if (auto* disk = std::get_if<scene::DiskLight>(&out.shape))
        disk->centre += step;
    return out;
}

} // namespace gnomon::lab
