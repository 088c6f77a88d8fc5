// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "scene/load.h"
#include "shadow/technique.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

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

int list_scenes(const List& options)
{
    Json json = Json::array();
    for (const scene::Builtin& b : scene::builtins()) {
        const scene::Scene scene = b.make(1.0);
        Json cameras = Json::array(), lights = Json::array();
        for (const scene::Camera& c : scene.cameras) cameras.push_back(c.name);
        for (const scene::Light& l : scene.lights) lights.push_back(l.name);
        json.push_back(
            {{"name", b.name}, {"triangles", scene.triangle_count()}, {"help", b.help}, {"cameras", cameras}, {"lights", lights}});
        if (!options.common.json) fmt::print("{:<16} {:>8} triangles  {}\n", b.name, scene.triangle_count(), b.help);
    }
    if (options.common.json) fmt::print("{}\n", json.dump(1));
    return 0;
}

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

/// The devices as JSON, and the one that would be used; without any, why.
std::unique_ptr<gpu::Device> find_device(const List& options, Json& devices, std::string& why)
{
    try {
        for (const gpu::DeviceInfo& d : gpu::Device::enumerate())
            devices.push_back({{"name", d.name}, {"driver", d.driver}, {"missing", d.missing}});
        return open_device(options.common);
    } catch (const base::Error& e) {
        // a misspelt --device is an error; no device at all still leaves something to list
        if (!options.common.device.empty()) throw;
        why = e.what();
        return nullptr;
    }
}

} // namespace

int list(const List& options)
{
    if (options.scenes) return list_scenes(options);
    Json devices = Json::array(), all = Json::array();
    std::string why;
    const auto device = find_device(options, devices, why);
    for (const shadow::TechniqueInfo* info : shadow::techniques()) {
        const std::string reason = !device ? why : info->unavailable ? info->unavailable(*device) : "";
        all.push_back({{"id", info->id}, {"title", info->title}, {"family", info->family}, {"output", shadow::output_name(info->output)},
            {"lights", lights_text(info->lights)}, {"soft", info->soft}, {"textured", info->textured}, {"exact", info->exact},
            {"unavailable", reason}, {"parameters", parameters_json(*info)}});
    }
    const std::string used = device ? device->info().name : "";
    if (options.common.json) {
        fmt::print("{}\n", Json{{"device", used}, {"devices", devices}, {"techniques", all}}.dump(1));
        return 0;
    }
    if (!device) fmt::print("no device: {}\n", why);
    for (const Json& d : devices) {
        const std::string name = d["name"], missing = d["missing"];
        fmt::print("device: {}, {}{}\n", name, std::string(d["driver"]),
            missing.empty() ? (name == used ? "  <- used" : "") : "  (not usable, lacks " + missing + ")");
    }
    fmt::print("\n{:<22} {:<21} {:<26} {}\n", "technique", "output", "lights", "title");
    for (const Json& t : all) {
        const std::string reason = t["unavailable"];
        const std::string output = std::string(t["output"]) + (t["textured"] ? " (coloured)" : "");
        fmt::print("{:<22} {:<21} {:<26} {}{}\n", std::string(t["id"]), output, std::string(t["lights"]), std::string(t["title"]),
            reason.empty() || !device ? "" : "\n    not here: " + reason);
    }
    return 0;
}

} // namespace gnomon::cli
