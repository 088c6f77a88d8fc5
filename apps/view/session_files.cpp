// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"

#include <nlohmann/json.hpp>

// Presets and screenshots.
namespace gnomon::view {

namespace fs = std::filesystem;

namespace {

/// out/NAME.png, or with the first number that is free.
fs::path free_name(const std::string& stem)
{
    fs::path file = fs::path("out") / (stem + ".png");
    for (int i = 2; fs::exists(file); ++i) file = fs::path("out") / fmt::format("{}.{}.png", stem, i);
    return file;
}

} // namespace

void Session::save_preset(const fs::path& file) const
{
    if (file.extension() != ".json") base::fail("'{}' is no name for a preset; end it with .json", file.string());
    const nlohmann::ordered_json json = {{"technique", std::string(left.info->id)}, {"parameters", left.params.json()}};
    base::write_text(file, json.dump(2) + "\n");
}

void Session::load_preset(const fs::path& file)
{
    const std::string text = base::read_text(file, 1 << 20);
    nlohmann::ordered_json json;
    try {
        json = nlohmann::ordered_json::parse(text);
        const std::string id = json.at("technique").get<std::string>();
        lab::Choice choice{&shadow::technique(id), shadow::ParamValues(shadow::technique(id).params())};
        choice.params.set_json(json.at("parameters"));
        technique(id);
        left = choice;
    } catch (const nlohmann::json::exception& e) {
        base::fail(
            "'{}' is no preset, which is an object with technique and parameters ({}); save one to see its form", file.string(), e.what());
    } catch (const base::Error& e) {
        base::fail("preset '{}': {}", file.string(), e.what());
    }
}

fs::path Session::screenshot(const std::string& name) const
{
    const fs::path file
        = name.empty() ? free_name("view." + fs::path(options_.scene).stem().string() + "." + std::string(left.info->id)) : fs::path(name);
    if (file.extension() != ".png") base::fail("'{}' is no name for a screenshot; end it with .png", file.string());
    const bool plain
        = look.show == 0 && against == Against::nothing && !look.wireframe && !overlays.layers && !overlays.volumes && overlays.inspect < 0;
    if (plain && picture().left().valid)
        base::write_png(file, lab::display(picture().radiance(), stage(), look.exposure), base::Encoding::srgb);
    else
        base::write_png(file, picture().shown(), base::Encoding::linear);
    return file;
}

} // namespace gnomon::view
