// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/names.h"
#include "scene/option_text.h"
#include "scene/rebase.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

constexpr float largest_size = 1e6f; // metres
constexpr float smallest_size = 1e-6f;

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// A light in the making: where a key can be given in two ways or left out, what was given.
struct Draft {
    Light light;
    std::string_view text;
    vec3 origin{0}; ///< of the light, not of the text
    bool known = false; ///< starts from a light of the scene, whose aim is kept
    bool moved = false, aimed = false;
    vec3 target{0};

    OptionPlace place(std::string_view key) const { return {"light", text, key}; }
    float number(const auto& pair, float low, float high, std::string_view unit) const
    {
        return option_number(place(pair.first), pair.second, low, high, unit);
    }
    float radians(const auto& pair, float low, float high) const { return glm::radians(number(pair, low, high, "degrees")); }
    vec3 vector(const auto& pair) const { return option_vec3(place(pair.first), pair.second); }
    vec3 point(const auto& pair) const { return option_point(place(pair.first), pair.second, origin); }
};

vec3 direction_from_angles(float elevation, float azimuth)
{
    return -vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth));
}

vec3 unit_or_fail(const Draft& draft, vec3 v, std::string_view from, std::string_view to)
{
    const float length = glm::length(v);
    if (!(length > 0.0f)) base::fail("light '{}': {} and {} are the same point; move one of them", draft.text, from, to);
    return v / length;
}

/// True where the key is one of all kinds.
bool common_key(Draft& draft, const Pairs::value_type& pair)
{
    if (pair.first == "color")
        draft.light.color = option_color(draft.place(pair.first), pair.second);
    else if (pair.first == "intensity")
        draft.light.intensity = draft.number(pair, 0.0f, 1e12f, "");
    else if (pair.first == "name")
        draft.light.name = pair.second;
    else
        return false;
    return true;
}

[[noreturn]] void no_such_key(const Draft& draft, std::string_view key, std::vector<std::string> keys)
{
    if (key == "image") base::fail("light '{}': only rect lights have an image, not {} lights", draft.text, kind_name(draft.light.kind()));
    keys.insert(keys.end(), {"color", "intensity", "name"});
    unknown_key(draft.place(key), keys);
}

void apply(Draft& draft, DirectionalLight& light, const Pairs& pairs)
{
    float elevation = std::asin(std::clamp(-light.direction.y, -1.0f, 1.0f));
    float azimuth = std::atan2(-light.direction.x, -light.direction.z);
    bool by_angles = false, by_vector = false;
    for (const auto& pair : pairs) {
        if (common_key(draft, pair)) continue;
        if (pair.first == "elevation")
            elevation = draft.radians(pair, -90.0f, 90.0f), by_angles = true;
        else if (pair.first == "azimuth")
            azimuth = draft.radians(pair, -360.0f, 360.0f), by_angles = true;
        else if (pair.first == "angle")
            light.angular_radius = 0.5f * draft.radians(pair, 0.0f, 180.0f);
        else if (pair.first == "direction")
            light.direction = unit_or_fail(draft, draft.vector(pair), "direction", "0/0/0"), by_vector = true;
        else
            no_such_key(draft, pair.first, {"elevation", "azimuth", "angle", "direction"});
    }
    if (by_angles && by_vector) base::fail("light '{}': give either direction or elevation and azimuth, not both", draft.text);
    if (by_angles) light.direction = direction_from_angles(elevation, azimuth);
}

/// position and target, which spot, rect and disk share.
bool placing_key(Draft& draft, vec3& position, const Pairs::value_type& pair)
{
    if (pair.first == "position")
        position = draft.point(pair), draft.moved = true;
    else if (pair.first == "target")
        draft.target = draft.point(pair), draft.aimed = true;
    else
        return false;
    return true;
}

/// A fresh light looks at the scene's centre unless told otherwise; one of the scene's own keeps its direction.
vec3 aim(const Draft& draft, vec3 position, vec3 direction)
{
    if (draft.aimed) return unit_or_fail(draft, draft.target - position, "position", "target");
    if (draft.known) return direction;
    const vec3 to = draft.target - position;
    return glm::length(to) > 0.0f ? glm::normalize(to) : vec3(0, -1, 0);
}

void apply(Draft& draft, SpotLight& light, const Pairs& pairs)
{
    bool inner = false;
    for (const auto& pair : pairs) {
        if (common_key(draft, pair) || placing_key(draft, light.position, pair)) continue;
        if (pair.first == "cone")
            light.outer_angle = 0.5f * draft.radians(pair, 0.1f, 179.0f);
        else if (pair.first == "inner")
            light.inner_angle = 0.5f * draft.radians(pair, 0.0f, 179.0f), inner = true;
        else if (pair.first == "radius")
            light.radius = draft.number(pair, 0.0f, largest_size, "m");
        else
            no_such_key(draft, pair.first, {"position", "target", "cone", "inner", "radius"});
    }
    if (inner && light.inner_angle > light.outer_angle) base::fail("light '{}': inner is wider than cone; lower it", draft.text);
    light.inner_angle = std::min(light.inner_angle, light.outer_angle);
    light.direction = aim(draft, light.position, light.direction);
}

void apply(Draft& draft, PointLight& light, const Pairs& pairs)
{
    for (const auto& pair : pairs) {
        if (common_key(draft, pair)) continue;
        if (pair.first == "position")
            light.position = draft.point(pair);
        else if (pair.first == "radius")
            light.radius = draft.number(pair, 0.0f, largest_size, "m");
        else
            no_such_key(draft, pair.first, {"position", "radius"});
    }
}

void apply(Draft& draft, RectLight& light, const Pairs& pairs)
{
    float width = 2.0f * glm::length(light.half_u), height = 2.0f * glm::length(light.half_v);
    for (const auto& pair : pairs) {
        if (common_key(draft, pair) || placing_key(draft, light.centre, pair)) continue;
        if (pair.first == "width")
            width = draft.number(pair, smallest_size, largest_size, "m");
        else if (pair.first == "height")
            height = draft.number(pair, smallest_size, largest_size, "m");
        else if (pair.first == "image")
            draft.light.image = load_light_image(pair.second);
        else
            no_such_key(draft, pair.first, {"position", "target", "width", "height", "image"});
    }
    if (draft.known && !draft.aimed) {
        light.half_u = 0.5f * width * glm::normalize(light.half_u);
        light.half_v = 0.5f * height * glm::normalize(light.half_v);
        return;
    }
    // `width` lies level wherever the light is not pointing straight up or down; then it lies along x.
    const vec3 normal = aim(draft, light.centre, vec3(0, -1, 0));
    const vec3 level = glm::cross(vec3(0, 1, 0), normal);
    const vec3 u = glm::length(level) > 1e-4f ? glm::normalize(level) : vec3(1, 0, 0);
    light.half_u = 0.5f * width * u;
    light.half_v = 0.5f * height * glm::normalize(glm::cross(normal, u));
}

void apply(Draft& draft, DiskLight& light, const Pairs& pairs)
{
    for (const auto& pair : pairs) {
        if (common_key(draft, pair) || placing_key(draft, light.centre, pair)) continue;
        if (pair.first == "radius")
            light.radius = draft.number(pair, smallest_size, largest_size, "m");
        else
            no_such_key(draft, pair.first, {"position", "target", "radius"});
    }
    light.normal = aim(draft, light.centre, light.normal);
}

/// A light of the kind named, fitted to the bounds: above and to one side of them.
std::optional<Light> fresh_light(std::string_view kind, const Bounds& bounds)
{
    const float size = std::max(bounds.radius(), smallest_size);
    const vec3 centre = bounds.empty() ? vec3(0.0f) : bounds.centre();
    const vec3 above = centre + 1.5f * size * glm::normalize(vec3(0.5f, 1.0f, 0.4f));
    Light light;
    light.name = kind;
    if (kind == "sun" || kind == "directional")
        light.shape = DirectionalLight{direction_from_angles(glm::radians(45.0f), glm::radians(40.0f)), 0.0f};
    else if (kind == "spot")
        light.shape = SpotLight{above, vec3(0, -1, 0), 0.0f, glm::radians(40.0f), 0.0f};
    else if (kind == "point")
        light.shape = PointLight{above, 0.0f};
    else if (kind == "rect")
        light.shape = RectLight{above, vec3(0.1f * size, 0, 0), vec3(0, 0, 0.1f * size)};
    else if (kind == "disk")
        light.shape = DiskLight{above, vec3(0, -1, 0), 0.1f * size};
    else
        return std::nullopt;
    return light;
}

} // namespace

Light parse_light(std::string_view text, const std::vector<Light>& known, const Bounds& bounds, vec3 origin)
{
    const OptionText options = split_options(text);
    Draft draft;
    draft.text = text, draft.origin = origin;
    draft.target = bounds.empty() ? vec3(0.0f) : bounds.centre();
    const auto own = std::find_if(known.begin(), known.end(), [&](const Light& l) { return l.name == options.name; });
    if (own != known.end()) {
        draft.light = *own, draft.known = true;
    } else if (auto fresh = fresh_light(options.name, bounds)) {
        draft.light = *fresh;
    } else {
        std::vector<std::string> names = {"sun", "directional", "spot", "point", "rect", "disk"};
        for (const Light& l : known) names.push_back(l.name);
        if (options.name.empty()) base::fail("light '{}' begins with no kind or name; begin with sun, spot, point, rect or disk", text);
        base::fail("light '{}': {}", text, base::unknown_name("kind or name", options.name, names));
    }
    std::visit([&](auto& shape) { apply(draft, shape, options.pairs); }, draft.light.shape);
    return draft.light;
}

Light parse_light(std::string_view text, const std::vector<Light>& known, const Bounds& bounds)
{
    return parse_light(text, known, bounds, vec3(0));
}

} // namespace gnomon::scene
