// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "scene/json_reader.h"
#include "scene/load.h"

#include <algorithm>
#include <cstdlib>

namespace gnomon::scene {

namespace {

using Json = nlohmann::ordered_json;

/// The shortest decimal that reads back as the same float, instead of the float's long tail as a double.
Json number(float v) { return std::strtod(fmt::format("{}", v).c_str(), nullptr); }
/// Degrees are rounded: seven digits are what radians in float hold.
Json degrees(float radians) { return std::strtod(fmt::format("{:.7g}", glm::degrees(double(radians))).c_str(), nullptr); }
Json vector(vec3 v) { return Json::array({number(v.x), number(v.y), number(v.z)}); }

struct ShapeWriter {
    Json& json;

    void operator()(const DirectionalLight& l) const
    {
        json["direction"] = vector(l.direction);
        if (l.angular_radius > 0.0f) json["angle_deg"] = degrees(2.0f * l.angular_radius);
    }
    void operator()(const SpotLight& l) const
    {
        json["position"] = vector(l.position), json["direction"] = vector(l.direction);
        json["cone_deg"] = degrees(2.0f * l.outer_angle), json["inner_cone_deg"] = degrees(2.0f * l.inner_angle);
        if (l.radius > 0.0f) json["radius"] = number(l.radius);
    }
    void operator()(const PointLight& l) const
    {
        json["position"] = vector(l.position);
        if (l.radius > 0.0f) json["radius"] = number(l.radius);
    }
    void operator()(const RectLight& l) const
    {
        json["position"] = vector(l.centre), json["direction"] = vector(glm::normalize(glm::cross(l.half_u, l.half_v)));
        json["width_axis"] = vector(glm::normalize(l.half_u));
        json["width"] = number(2.0f * glm::length(l.half_u)), json["height"] = number(2.0f * glm::length(l.half_v));
    }
    void operator()(const DiskLight& l) const
    {
        json["position"] = vector(l.centre), json["direction"] = vector(l.normal);
        json["radius"] = number(l.radius);
    }
};

Json image_json(const LightImage& image)
{
    Json rows = Json::array();
    for (int y = 0; y < image.height; ++y) {
        Json row = Json::array();
        for (int x = 0; x < image.width; ++x) row.push_back(vector(image.tint * image.texels[size_t(y) * size_t(image.width) + size_t(x)]));
        rows.push_back(std::move(row));
    }
    return rows;
}

Json light_json(const Light& light)
{
    Json json;
    json["name"] = light.name;
    json["type"] = std::string(kind_name(light.kind()));
    std::visit(ShapeWriter{json}, light.shape);
    if (light.color != vec3(1.0f)) json["color"] = vector(light.color);
    if (light.intensity) json["intensity"] = number(*light.intensity);
    if (light.textured()) json["image"] = image_json(light.image);
    return json;
}

Json camera_json(const Camera& camera)
{
    Json json;
    json["name"] = camera.name;
    json["eye"] = vector(camera.eye), json["target"] = vector(camera.target);
    if (camera.up != vec3(0, 1, 0)) json["up"] = vector(camera.up);
    if (camera.half_height > 0.0f)
        json["half_height"] = number(camera.half_height);
    else
        json["fov_deg"] = degrees(camera.fov_y);
    if (camera.near > 0.0f) json["near"] = number(camera.near);
    return json;
}

/// "sun", "sun 2" ... where the list gives lights no names.
std::string fresh_name(std::string name, const std::vector<Light>& lights)
{
    const auto used
        = [&](const std::string& n) { return std::any_of(lights.begin(), lights.end(), [&](const Light& l) { return l.name == n; }); };
    const std::string stem = name;
    for (int i = 2; used(name); ++i) name = stem + " " + std::to_string(i);
    return name;
}

Light convert_light(const JsonReader& r, const std::vector<Light>& before)
{
    const std::string type = r.at("type").text();
    Light light;
    light.name = fresh_name(type == "directional" ? "sun" : type, before);
    if (type == "directional") {
        light.shape = DirectionalLight{r.at("direction").direction(), 0.0f};
    } else if (type == "spot") {
        const vec3 position = r.at("position").vector();
        const vec3 to = r.at("target").vector() - position;
        if (!(glm::length(to) > 0.0f)) r.at("target").fail("is the light's own position");
        light.shape = SpotLight{position, glm::normalize(to), 0.0f, 0.5f * glm::radians(r.at("cone_deg").real(0.1f, 179.0f)), 0.0f};
    } else if (type == "point" || type == "sphere") {
        light.shape = PointLight{r.at("position").vector(), r.has("radius") ? r.at("radius").real(0.0f, 1e6f) : 0.0f};
    } else {
        r.at("type").fail(fmt::format("is '{}', but the list may hold directional, spot, point and sphere lights", type));
    }
    return light;
}

} // namespace

std::string scene_json_text(const Scene& scene, std::string_view model, const LoadOptions& options)
{
    const LoadOptions defaults;
    Json json;
    json["model"] = std::string(model);
    if (options.detail != defaults.detail) json["detail"] = options.detail;
    if (options.time != defaults.time) json["time"] = options.time;
    if (options.gltf_scene != defaults.gltf_scene) json["gltf_scene"] = options.gltf_scene;
    if (scene.tuning) json["tuning"] = true;
    if (scene.validation) json["validation"] = true;
    json["cameras"] = Json::array();
    for (const Camera& camera : scene.cameras) json["cameras"].push_back(camera_json(camera));
    json["lights"] = Json::array();
    for (const Light& light : scene.lights) json["lights"].push_back(light_json(light));
    // A name that is no UTF-8 (from a damaged model) is written with replacement characters.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::pair<std::string, std::string>> convert_scene_list(const std::filesystem::path& path, const std::string& model_folder)
{
    const nlohmann::json json = read_json(path);
    const JsonReader list = JsonReader(json, path.string()).at("scenes");
    std::vector<std::pair<std::string, std::string>> texts;
    for (size_t i = 0; i < list.array_size(); ++i) {
        const JsonReader entry = list.at(i);
        Scene scene;
        scene.name = entry.at("name").text();
        const JsonReader cameras = entry.at("cameras"), lights = entry.at("lights");
        for (size_t k = 0; k < cameras.array_size(); ++k) {
            const JsonReader r = cameras.at(k);
            Camera camera;
            camera.name = r.at("name").text();
            camera.eye = r.at("eye").vector(), camera.target = r.at("target").vector();
            if (r.has("fov_y_deg")) camera.fov_y = glm::radians(r.at("fov_y_deg").real(1.0f, 170.0f));
            scene.cameras.push_back(camera);
        }
        for (size_t k = 0; k < lights.array_size(); ++k) scene.lights.push_back(convert_light(lights.at(k), scene.lights));
        const std::string model = (std::filesystem::path(model_folder) / entry.at("file").text()).generic_string();
        texts.emplace_back(scene.name, scene_json_text(scene, model));
    }
    return texts;
}

} // namespace gnomon::scene
