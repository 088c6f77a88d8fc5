// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include "scene/option_text.h"
#include "scene/rebase.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace gnomon::view {

namespace {

std::string text_of(vec3 v) { return fmt::format("{}/{}/{}", v.x, v.y, v.z); }

/// A point that is counted from `origin`. In doubles the sum is exact, so that reading it back gives the same floats.
std::string text_of(vec3 p, vec3 origin)
{
    if (origin == vec3(0)) return text_of(p);
    const glm::dvec3 at = glm::dvec3(p) + glm::dvec3(origin);
    return fmt::format("{}/{}/{}", at.x, at.y, at.z);
}

/// The shortest number of degrees that is read back as these radians, times `part` (0.5 where the text states a full angle and the light
/// keeps half of it).
std::string degrees_text(float radians, float part)
{
    const double degrees = glm::degrees(double(radians)) / double(part);
    std::string text;
    for (int digits = 2; digits <= 9; ++digits) {
        text = fmt::format("{:.{}g}", degrees, digits);
        if (part * glm::radians(std::strtof(text.c_str(), nullptr)) == radians) return text;
    }
    return text;
}

struct ShapeText {
    std::string operator()(const scene::DirectionalLight& l) const
    {
        return fmt::format(",direction={},angle={}", text_of(l.direction), degrees_text(l.angular_radius, 0.5f));
    }
    std::string operator()(const scene::SpotLight& l) const
    {
        return fmt::format(",position={},target={},cone={},inner={},radius={}", text_of(l.position, origin),
            text_of(l.position + l.direction, origin), degrees_text(l.outer_angle, 0.5f), degrees_text(l.inner_angle, 0.5f), l.radius);
    }
    std::string operator()(const scene::PointLight& l) const
    {
        return fmt::format(",position={},radius={}", text_of(l.position, origin), l.radius);
    }
    std::string operator()(const scene::RectLight& l) const
    {
        const std::string sizes = fmt::format(",width={},height={}", 2.0f * glm::length(l.half_u), 2.0f * glm::length(l.half_v));
        const std::string position = ",position=" + text_of(l.centre, origin);
        if (known) return position + sizes;
        return position + ",target=" + text_of(l.centre + glm::normalize(glm::cross(l.half_u, l.half_v)), origin) + sizes;
    }
    std::string operator()(const scene::DiskLight& l) const
    {
        return fmt::format(",position={},target={},radius={}", text_of(l.centre, origin), text_of(l.centre + l.normal, origin), l.radius);
    }
    bool known;
    vec3 origin;
};

bool has_light(const std::vector<scene::Light>& known, const std::string& name)
{
    return std::any_of(known.begin(), known.end(), [&](const scene::Light& l) { return l.name == name; });
}

} // namespace

std::string camera_text(const scene::Camera& camera, vec3 origin)
{
    std::string text = fmt::format("eye={},target={}", text_of(camera.eye, origin), text_of(camera.target, origin));
    if (camera.up != vec3(0, 1, 0)) text += ",up=" + text_of(camera.up);
    if (camera.half_height > 0.0f)
        text += fmt::format(",ortho={}", camera.half_height);
    else
        text += ",fov=" + degrees_text(camera.fov_y, 1.0f);
    if (camera.near > 0.0f) text += fmt::format(",near={}", camera.near);
    return text;
}

LightOrigin light_origin(const std::string& option, const std::vector<scene::Light>& known)
{
    const scene::OptionText parts = scene::split_options(option);
    LightOrigin origin{parts.name, {}, has_light(known, parts.name)};
    for (const auto& [key, value] : parts.pairs)
        if (key == "image") origin.image = value;
    for (const scene::Light& l : known)
        if (l.name == parts.name) { // of two lights of one name the first is found
            origin.color = l.color;
            break;
        }
    return origin;
}

LightOrigin light_origin(const scene::Light& light, const std::vector<scene::Light>& known, const Bounds& bounds, vec3 origin)
{
    const LightOrigin by_kind{std::string(scene::kind_name(light.kind())), {}, false};
    if (!has_light(known, light.name) || light.name.find('=') != std::string::npos) return by_kind;
    try {
        // Of two lights of one name the first is found.
        const scene::Light read = scene::parse_light(light.name, known, bounds, origin);
        if (read.kind() == light.kind()) return {light.name, {}, true, read.color};
    } catch (const std::exception&) {
    }
    return by_kind;
}

std::string light_text(const scene::Light& light, const LightOrigin& from, vec3 origin)
{
    std::string text = from.base + std::visit(ShapeText{from.known, origin}, light.shape);
    if (!from.image.empty()) text += ",image=" + from.image;
    if (light.color != from.color) text += ",color=" + text_of(light.color);
    if (light.intensity) text += fmt::format(",intensity={}", *light.intensity);
    return text;
}

std::string shell_word(const std::string& word)
{
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || std::string_view("/._-+=,:@%").find(char(c)) != std::string_view::npos;
    });
    if (plain) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string render_command(const CommandLine& line, const lab::Choice& choice)
{
    std::string text = "gnomon render " + shell_word(line.scene);
    const scene::LoadOptions defaults;
    if (line.load.time != defaults.time) text += fmt::format(" --time {}", line.load.time);
    if (line.load.detail != defaults.detail) text += fmt::format(" --detail {}", line.load.detail);
    if (line.load.gltf_scene != defaults.gltf_scene) text += fmt::format(" --gltf-scene {}", line.load.gltf_scene);
    text += " --camera " + shell_word(line.camera);
    for (const std::string& light : line.lights) text += " --light " + shell_word(light);
    text += fmt::format(" --size {}x{} --technique {}", line.size.width, line.size.height, choice.info->id);
    const shadow::ParamValues defaulted(choice.info->params());
    for (const shadow::ParamInfo& p : choice.params.table().fields)
        if (choice.params.get(p) != defaulted.get(p))
            text += fmt::format(" --{}.{} {}", choice.info->id, p.name, shell_word(choice.params.text(p)));
    if (line.exposure != 0) text += fmt::format(" --exposure {}", line.exposure);
    if (line.ambient != 0.45f) text += fmt::format(" --ambient {}", line.ambient);
    return text;
}

} // namespace gnomon::view
