// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "lab/export.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gnomon::cli {

namespace {

lab::Choice choice_of(const Export& options)
{
    lab::Choice choice = lab::parse_choice(options.technique);
    for (const std::string& item : options.set) {
        const size_t equals = item.find('=');
        if (equals == std::string::npos) base::fail("--set takes NAME=VALUE, not '{}'", item);
        choice.params.set(item.substr(0, equals), std::string_view(item).substr(equals + 1));
    }
    return choice;
}

/// The first kind that the technique takes, placed where the scene wants it.
std::string light_of(const Export& options, const shadow::TechniqueInfo& info)
{
    if (!options.light.empty()) return options.light;
    for (int k = 0; k < scene::light_kind_count; ++k)
        if (info.lights & (1u << k)) return std::string(scene::kind_name(scene::LightKind(k)));
    return "";
}

} // namespace

int export_shaders(const Export& options)
{
    const lab::Language language = lab::parse_language(options.language);
    const lab::Choice choice = choice_of(options);
    const lab::Stage stage
        = lab::open_stage({.scene = options.scene, .lights = {light_of(options, *choice.info)}, .size = lab::parse_size(options.size)});
    const auto device = open_device(options.common);
    const lab::Exported exported = lab::export_technique(*device, stage, choice, language);
    demand_valid(*device);
    lab::write_export(exported, options.output);

    nlohmann::ordered_json json
        = {{"folder", options.output}, {"files", nlohmann::ordered_json::array()}, {"refused", nlohmann::ordered_json::object()}};
    size_t shaders = 0;
    for (const auto& [file, content] : exported.files) {
        json["files"].push_back(file);
        shaders += file.find('/') == std::string::npos && file != "README.md" && file != "layouts.h" && file != "passes.json";
    }
    for (const auto& [shader, why] : exported.refused) json["refused"][shader] = why;
    if (options.common.json) {
        fmt::print("{}\n", json.dump(1));
    } else {
        fmt::print("{} shaders in {}, and README.md, which says how to run them\n", shaders, options.output);
        for (const auto& [shader, why] : exported.refused) fmt::print("not {}: {}: {}\n", options.language, shader, why);
    }
    // the folder is as whole as the language allows, yet a script should notice
    return exported.refused.empty() ? 0 : 1;
}

} // namespace gnomon::cli
