// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "lab/folder.h"
#include "lab/json_keys.h"

#include <nlohmann/json.hpp>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

TechniqueScene parse(const Json& json, const fs::path& file)
{
    known_keys(json, {"scene", "detail", "camera", "lights", "params", "truth_samples", "promise", "golden_tolerance", "reference"}, file);
    TechniqueScene out;
    out.scene = json.at("scene").get<std::string>();
    out.detail = json.value("detail", 1.0);
    out.camera = json.value("camera", "");
    out.truth_samples = whole_number(json, "truth_samples", 256, 1, 1 << 20);
    out.reference = json.value("reference", "");
    if (json.contains("params")) out.params = json["params"].dump();
    for (const auto& [kind, light] : json.at("lights").items()) out.lights[kind] = light.get<std::string>();
    for (const auto& [kind, bounds] : json.at("promise").items())
        for (const auto& [metric, bound] : bounds.items()) out.promise[kind][metric] = bound.get<double>();
    if (json.contains("golden_tolerance")) {
        const Json& tolerance = json["golden_tolerance"];
        known_keys(tolerance, {"pixels", "mean", "reason"}, file);
        if (tolerance.value("reason", "").empty()) base::fail("{}: golden_tolerance needs a \"reason\"", file.string());
        out.golden_pixels = tolerance.value("pixels", out.golden_pixels), out.golden_mean = tolerance.value("mean", out.golden_mean);
    }
    return out;
}

} // namespace

TechniqueScene read_technique_scene(const fs::path& folder)
{
    const fs::path file = folder / "scene.json";
    try {
        return parse(parse_json(base::read_text(file), file), file);
    } catch (const nlohmann::json::exception& e) {
        base::fail("{}: {}", file.string(), e.what());
    }
}

} // namespace gnomon::lab
