// SPDX-License-Identifier: Apache-2.0
#include "lab/catalogue.h"

#include "scene/load.h"

namespace gnomon::lab {

namespace {

using Json = nlohmann::ordered_json;

std::string lights_text(unsigned mask)
{
    if (mask == shadow::all_lights) return "all";
    std::string out;
    for (int k = 0; k < scene::light_kind_count; ++k)
        if (mask & (1u << k)) out += (out.empty() ? "" : " ") + std::string(scene::kind_name(scene::LightKind(k)));
    return out;
}

} // namespace

Json parameters_json(const shadow::TechniqueInfo& info)
{
    const shadow::ParamValues values(info.params());
    const Json defaults = values.json();
    Json out = Json::array();
    for (const shadow::ParamInfo& p : values.table().fields) {
        Json entry = {{"name", p.name}, {"default", defaults[p.name]}, {"unit", p.unit}, {"help", p.help}};
        if (!p.choices.empty())
            entry["choices"] = p.choices;
        else
            entry["range"] = {p.range.min, p.range.max};
        out.push_back(entry);
    }
    return out;
}

Json techniques_json(const gpu::Device* device, const std::string& why)
{
    Json out = Json::array();
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const std::string reason = !device ? why : info->unavailable ? info->unavailable(*device) : "";
        out.push_back({{"id", info->id}, {"title", info->title}, {"family", info->family}, {"output", shadow::output_name(info->output)},
            {"lights", lights_text(info->lights)}, {"soft", info->soft}, {"textured", info->textured}, {"exact", info->exact},
            {"unavailable", reason}, {"parameters", parameters_json(*info)}});
    }
    return out;
}

Json devices_json()
{
    Json out = Json::array();
    for (const gpu::DeviceInfo& d : gpu::Device::enumerate())
        out.push_back({{"name", d.name}, {"driver", d.driver}, {"software", d.software}, {"missing", d.missing}});
    return out;
}

Json scenes_json()
{
    Json out = Json::array();
    for (const scene::Builtin& b : scene::builtins()) {
        const scene::Scene scene = b.make(1.0);
        Json cameras = Json::array(), lights = Json::array();
        for (const scene::Camera& c : scene.cameras) cameras.push_back(c.name);
        for (const scene::Light& l : scene.lights) lights.push_back(l.name);
        out.push_back(
            {{"name", b.name}, {"triangles", scene.triangle_count()}, {"help", b.help}, {"cameras", cameras}, {"lights", lights}});
    }
    return out;
}

} // namespace gnomon::lab
