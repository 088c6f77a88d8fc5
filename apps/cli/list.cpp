// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "lab/catalogue.h"
#include "lab/quality.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace {

using Json = nlohmann::ordered_json;

int list_scenes(const List& options)
{
    const Json scenes = lab::scenes_json();
    if (options.common.json)
        fmt::print("{}\n", scenes.dump(1));
    else
        for (const Json& s : scenes)
            fmt::print(
                "{:<16} {:>8} triangles  {}\n", s["name"].get<std::string>(), s["triangles"].get<size_t>(), s["help"].get<std::string>());
    return 0;
}

/// The devices as JSON, and the one that would be used; without any, why.
std::unique_ptr<gpu::Device> find_device(const List& options, Json& devices, std::string& why)
{
    try {
        devices = lab::devices_json();
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
    if (options.qualities) {
        fmt::print("{}", options.common.json ? lab::qualities_json().dump(1) + "\n" : lab::qualities_text());
        return 0;
    }
    if (options.scenes) return list_scenes(options);
    Json devices = Json::array();
    std::string why;
    const auto device = find_device(options, devices, why);
    const Json all = lab::techniques_json(device.get(), why);
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
