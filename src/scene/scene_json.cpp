// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/names.h"
#include "scene/json_reader.h"
#include "scene/load.h"
#include "scene/scene_json_material.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::scene {

namespace {

using Keys = std::vector<std::string>;

constexpr float largest_size = 1e6f, smallest_size = 1e-6f; // metres

float radians_at(const JsonReader& object, const char* key, float low, float high) { return glm::radians(object.at(key).real(low, high)); }

void check_light_keys(const JsonReader& r, Keys keys)
{
    if (r.has("image") && r.at("type").text() != "rect") r.at("image").fail("is for rect lights only");
    keys.insert(keys.end(), {"name", "type", "color", "intensity"});
    r.check_keys(keys);
}

/// From "target" or "direction", one of which must be there.
vec3 aim_of(const JsonReader& r, vec3 position)
{
    if (r.has("target") == r.has("direction")) r.fail("give either target or direction");
    if (r.has("direction")) return r.at("direction").direction();
    const vec3 v = r.at("target").vector() - position;
    const float length = glm::length(v);
    if (!(length > 0.0f)) r.at("target").fail("is the light's own position; move one of them");
    return v / length;
}

SpotLight read_spot(const JsonReader& r)
{
    check_light_keys(r, {"position", "target", "direction", "cone_deg", "inner_cone_deg", "radius"});
    SpotLight light;
    light.position = r.at("position").vector();
    light.direction = aim_of(r, light.position);
    if (r.has("cone_deg")) light.outer_angle = 0.5f * radians_at(r, "cone_deg", 0.1f, 179.0f);
    if (r.has("inner_cone_deg")) light.inner_angle = 0.5f * radians_at(r, "inner_cone_deg", 0.0f, 179.0f);
    if (light.inner_angle > light.outer_angle) r.at("inner_cone_deg").fail("is wider than cone_deg");
    if (r.has("radius")) light.radius = r.at("radius").real(0.0f, largest_size);
    return light;
}

RectLight read_rect(const JsonReader& r)
{
    check_light_keys(r, {"position", "target", "direction", "width", "height", "width_axis", "image"});
    RectLight light;
    light.centre = r.at("position").vector();
    const vec3 normal = aim_of(r, light.centre);
    vec3 axis = glm::cross(vec3(0, 1, 0), normal); // level, unless the light points straight up or down
    if (r.has("width_axis"))
        axis = r.at("width_axis").direction();
    else if (!(glm::length(axis) > 1e-4f))
        axis = vec3(1, 0, 0);
    axis -= normal * glm::dot(axis, normal);
    if (!(glm::length(axis) > 1e-4f)) r.at("width_axis").fail("runs along the light's direction");
    const vec3 u = glm::normalize(axis);
    light.half_u = 0.5f * r.at("width").real(smallest_size, largest_size) * u;
    light.half_v = 0.5f * r.at("height").real(smallest_size, largest_size) * glm::normalize(glm::cross(normal, u));
    return light;
}

/// A name, or rows of texels, each [red, green, blue].
LightImage read_image(const JsonReader& r, const std::filesystem::path& folder)
{
    if (r.is_text()) return load_light_image(r.text(), folder);
    const int height = int(r.array_size()), width = height > 0 ? int(r.at(size_t(0)).array_size()) : 0;
    if (width < 1) r.fail("has no texels; give rows of [red, green, blue], or the name of an image");
    std::vector<vec3> emitted;
    for (int y = 0; y < height; ++y) {
        const JsonReader row = r.at(size_t(y));
        if (int(row.array_size()) != width) row.fail(fmt::format("has {} texels instead of {}", row.array_size(), width));
        for (int x = 0; x < width; ++x) emitted.push_back(row.at(size_t(x)).vector(0.0f));
    }
    return make_light_image(width, height, emitted, r.place());
}

LightShape read_shape(const JsonReader& r, const std::string& type)
{
    if (type == "directional") {
        check_light_keys(r, {"direction", "angle_deg"});
        DirectionalLight light{r.at("direction").direction(), 0.0f};
        if (r.has("angle_deg")) light.angular_radius = 0.5f * radians_at(r, "angle_deg", 0.0f, 180.0f);
        return light;
    }
    if (type == "spot") return read_spot(r);
    if (type == "point") {
        check_light_keys(r, {"position", "radius"});
        return PointLight{r.at("position").vector(), r.has("radius") ? r.at("radius").real(0.0f, largest_size) : 0.0f};
    }
    if (type == "rect") return read_rect(r);
    if (type == "disk") {
        check_light_keys(r, {"position", "target", "direction", "radius"});
        const vec3 centre = r.at("position").vector();
        return DiskLight{centre, aim_of(r, centre), r.at("radius").real(smallest_size, largest_size)};
    }
    r.at("type").fail(base::unknown_name("type", type, Keys{"directional", "spot", "point", "rect", "disk"}));
}

Light read_light(const JsonReader& r, size_t index, const std::filesystem::path& folder)
{
    Light light;
    light.shape = read_shape(r, r.at("type").text());
    light.name = r.has("name") ? r.at("name").text() : "light " + std::to_string(index + 1);
    if (r.has("color")) light.color = r.at("color").vector(0.0f);
    if (r.has("intensity")) light.intensity = r.at("intensity").real(0.0f, 1e12f);
    if (r.has("image")) light.image = read_image(r.at("image"), folder);
    return light;
}

Camera read_camera(const JsonReader& r, size_t index)
{
    r.check_keys(Keys{"name", "eye", "target", "up", "fov_deg", "half_height", "near"});
    Camera camera;
    camera.name = r.has("name") ? r.at("name").text() : "camera " + std::to_string(index + 1);
    camera.eye = r.at("eye").vector();
    camera.target = r.at("target").vector();
    if (camera.eye == camera.target) r.at("target").fail("is the camera's own eye; move one of them");
    if (r.has("up")) camera.up = r.at("up").direction();
    if (r.has("fov_deg") && r.has("half_height")) r.fail("give either fov_deg (perspective) or half_height (orthographic)");
    if (r.has("fov_deg")) camera.fov_y = radians_at(r, "fov_deg", 1.0f, 170.0f);
    if (r.has("half_height")) camera.half_height = r.at("half_height").real(smallest_size, largest_size);
    if (r.has("near")) camera.near = r.at("near").real(0.0f, largest_size);
    return camera;
}

/// The file's own entries first, then those of the model whose names are not taken.
template <class T, class Read> void merge(std::vector<T>& models, const JsonReader& file, const char* key, Read read)
{
    if (!file.has(key)) return;
    std::vector<T> all;
    std::set<std::string> taken;
    const JsonReader list = file.at(key);
    for (size_t i = 0; i < list.array_size(); ++i) {
        T entry = read(list.at(i), i);
        if (!taken.insert(entry.name).second) list.at(i).fail(fmt::format("the name '{}' is there twice", entry.name));
        all.push_back(std::move(entry));
    }
    for (T& entry : models)
        if (taken.insert(entry.name).second) all.push_back(std::move(entry));
    models = std::move(all);
}

/// A value of the file, unless the caller asked for another than the default.
template <class T> T chosen(const JsonReader& file, const char* key, T asked, T fallback, double low, double high)
{
    return asked == fallback && file.has(key) ? T(file.at(key).number(low, high)) : asked;
}

} // namespace

Scene load_scene_json(const std::filesystem::path& path, const LoadOptions& options)
{
    const nlohmann::json json = read_json(path);
    const JsonReader file(json, path.string());
    file.check_keys(Keys{"model", "detail", "time", "gltf_scene", "tuning", "validation", "cameras", "lights", "materials"});
    const LoadOptions defaults;
    LoadOptions inner;
    inner.time = chosen(file, "time", options.time, defaults.time, 0.0, 1e9);
    inner.detail = chosen(file, "detail", options.detail, defaults.detail, 0.05, 256.0);
    inner.gltf_scene = chosen(file, "gltf_scene", options.gltf_scene, defaults.gltf_scene, 0.0, 1e6);

    const std::string model = file.at("model").text();
    const bool builtin = std::any_of(builtins().begin(), builtins().end(), [&](const Builtin& b) { return b.name == model; });
    // One scene file naming another could name itself.
    if (std::filesystem::path(model).extension() == ".json")
        file.at("model").fail("is another scene file; name a .glb, a .gltf or a built-in scene");
    Scene scene = load(builtin ? model : (path.parent_path() / model).string(), inner);
    scene.name = path.stem().string();
    if (file.has("tuning")) scene.tuning = file.at("tuning").truth();
    if (file.has("validation")) scene.validation = file.at("validation").truth();
    merge(scene.cameras, file, "cameras", read_camera);
    merge(scene.lights, file, "lights", [&](const JsonReader& r, size_t i) { return read_light(r, i, path.parent_path()); });
    if (file.has("materials")) change_materials(scene, file.at("materials"));
    return scene;
}

} // namespace gnomon::scene
