// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/names.h"
#include "scene/option_text.h"
#include "scene/rebase.h"

namespace gnomon::scene {

namespace {

/// By full name, else by a part that only one name has.
const Camera* find_camera(std::string_view text, std::string_view name, const std::vector<Camera>& known)
{
    std::vector<std::string> parts;
    const Camera* found = nullptr;
    for (const Camera& c : known) {
        if (c.name == name) return &c;
        if (c.name.find(name) != std::string::npos) found = &c, parts.push_back("'" + c.name + "'");
    }
    if (parts.size() > 1) base::fail("camera '{}': '{}' is part of {}; name one of them in full", text, name, fmt::join(parts, " and "));
    return found;
}

void apply(Camera& camera, const OptionPlace& place, std::string_view value, vec3 origin)
{
    if (place.key == "eye")
        camera.eye = option_point(place, value, origin);
    else if (place.key == "target")
        camera.target = option_point(place, value, origin);
    else if (place.key == "up")
        camera.up = option_vec3(place, value);
    else if (place.key == "fov")
        camera.fov_y = glm::radians(option_number(place, value, 1.0f, 170.0f, "degrees")), camera.half_height = 0.0f;
    else if (place.key == "near")
        camera.near = option_number(place, value, 1e-6f, 1e6f, "m");
    else if (place.key == "ortho")
        camera.half_height = option_number(place, value, 1e-6f, 1e6f, "m");
    else if (place.key == "name")
        camera.name = value;
    else
        unknown_key(place, std::vector<std::string>{"eye", "target", "up", "fov", "near", "ortho", "name"});
}

} // namespace

Camera parse_camera(std::string_view text, const std::vector<Camera>& known, const Bounds& bounds, vec3 origin)
{
    const OptionText options = split_options(text);
    Camera camera;
    if (options.name.empty() && options.pairs.empty()) base::fail("a camera is missing; give a name, 'fit', or eye=x/y/z,target=x/y/z");
    const Camera* own = options.name.empty() ? nullptr : find_camera(text, options.name, known);
    if (own) {
        camera = *own;
    } else if (options.name.empty() || options.name == "fit") {
        camera = fit_camera(bounds);
    } else {
        std::vector<std::string> names = {"fit"};
        for (const Camera& c : known) names.push_back(c.name);
        base::fail("camera '{}': {}", text, base::unknown_name("name", options.name, names));
    }
    for (const auto& [key, value] : options.pairs) apply(camera, {"camera", text, key}, value, origin);
    if (glm::length(camera.target - camera.eye) <= 0.0f)
        base::fail("camera '{}': eye and target are the same point; move one of them", text);
    return camera;
}

Camera parse_camera(std::string_view text, const std::vector<Camera>& known, const Bounds& bounds)
{
    return parse_camera(text, known, bounds, vec3(0));
}

} // namespace gnomon::scene
