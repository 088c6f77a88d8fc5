// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_json_material.h"
#include "base/names.h"

#include <algorithm>
#include <map>

namespace gnomon::scene {

namespace {

AlphaMode alpha_mode(const JsonReader& r)
{
    const std::vector<std::string> names = {"opaque", "mask", "blend"};
    const auto found = std::find(names.begin(), names.end(), r.text());
    if (found == names.end()) r.fail(base::unknown_name("alpha", r.text(), names));
    return AlphaMode(found - names.begin());
}

void change(Material& m, const JsonReader& r)
{
    if (r.has("alpha")) m.alpha = alpha_mode(r.at("alpha"));
    if (r.has("color")) m.base_color = vec4(r.at("color").vector(0.0f, 1.0f), m.base_color.w);
    if (r.has("opacity")) m.base_color.w = r.at("opacity").real(0.0f, 1.0f);
    if (r.has("cutoff")) m.alpha_cutoff = r.at("cutoff").real(0.0f, 1.0f);
    if (r.has("textured") && !r.at("textured").truth()) m.base_color_texture = {};
    if (r.has("double_sided")) m.double_sided = r.at("double_sided").truth();
    if (r.has("metallic")) m.metallic = r.at("metallic").real(0.0f, 1.0f);
    if (r.has("roughness")) m.roughness = r.at("roughness").real(0.0f, 1.0f);
    if (r.has("transmission")) m.transmission = r.at("transmission").real(0.0f, 1.0f);
}

} // namespace

void change_materials(Scene& scene, const JsonReader& list)
{
    const std::vector<std::string> keys
        = {"name", "alpha", "color", "opacity", "cutoff", "textured", "double_sided", "metallic", "roughness", "transmission"};
    std::map<std::string, std::vector<Material*>> named;
    for (Material& m : scene.materials) named[m.name].push_back(&m);
    for (size_t i = 0; i < list.array_size(); ++i) {
        const JsonReader entry = list.at(i);
        entry.check_keys(keys);
        const std::string name = entry.at("name").text();
        const auto found = named.find(name);
        if (found == named.end()) {
            std::vector<std::string> names;
            for (const auto& [one, materials] : named) names.push_back(one);
            entry.at("name").fail(base::unknown_name("material", name, names));
        }
        for (Material* m : found->second) change(*m, entry);
    }
}

} // namespace gnomon::scene
