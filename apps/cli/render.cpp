// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "base/image_file.h"
#include "base/names.h"
#include "lab/aov.h"
#include "lab/quality.h"
#include "lab/render.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace gnomon::cli {

namespace fs = std::filesystem;

lab::StageOptions stage_options(const Picture& picture)
{
    lab::StageOptions out{picture.scene, {picture.time, picture.detail, picture.gltf_scene}, picture.camera, picture.lights, {}};
    const std::string& text = picture.size;
    const char* end = text.data() + text.size();
    const auto [cross, first] = std::from_chars(text.data(), end, out.size.width);
    const auto [last, second] = cross != end && *cross == 'x' ? std::from_chars(cross + 1, end, out.size.height)
                                                              : std::from_chars_result{cross, std::errc::invalid_argument};
    if (first != std::errc() || second != std::errc() || last != end)
        base::fail("--size takes WIDTHxHEIGHT in pixels, as 960x540, not '{}'", text);
    lab::check_size(out.size);
    return out;
}

std::string technique_id(const std::string& choice) { return std::string(lab::parse_choice(choice).info->id); }

namespace {

void check_aovs(const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        if (std::find(lab::aov_names().begin(), lab::aov_names().end(), name) == lab::aov_names().end())
            throw base::Error(base::unknown_name("aov", name, lab::aov_names()));
}

std::vector<std::string> channel_names(int channels)
{
    if (channels == 1) return {"Y"};
    if (channels == 2) return {"X", "Y"};
    return {"R", "G", "B"};
}

void write_picture(const fs::path& file, const base::Picture& scene_referred, const base::Picture& shown, base::Encoding encoding)
{
    if (file.extension() == ".exr")
        base::write_exr(file, scene_referred, channel_names(scene_referred.channels));
    else if (file.extension() == ".png")
        base::write_png(file, shown, encoding);
    else
        base::fail("'{}' is neither .png nor .exr; name the output file so", file.string());
}

} // namespace

int render(const Render& options)
{
    check_aovs(options.aovs);
    lab::Choice choice = lab::parse_choice(options.technique);
    for (const std::string& item : options.parameters) {
        const size_t equals = item.find('=');
        choice.params.set(item.substr(0, equals), std::string_view(item).substr(equals + 1));
    }
    lab::StageOptions stage_choice = stage_options(options.picture);
    if (options.quality.empty()) stage_choice.kinds = choice.info->lights;
    const lab::Stage stage = lab::open_stage(stage_choice);
    const auto device = open_device(options.common);
    if (!options.quality.empty()) choice = lab::quality_choice(options.quality, *device, stage.lights);
    for (const std::string& warning : stage.scene.warnings) fmt::print(stderr, "gnomon: warning: {}\n", warning);
    const fs::path file = options.output.empty()
        ? fs::path("out") / (fs::path(options.picture.scene).stem().string() + "." + std::string(choice.info->id) + ".png")
        : fs::path(options.output);
    if (file.extension() != ".png" && file.extension() != ".exr")
        base::fail("'{}' is neither .png nor .exr; name the output file so", file.string());
    shadow::SceneGpu scene(*device, stage.scene);
    lab::RenderSettings settings{.samples = options.samples,
        .repeats = options.repeats,
        .frame_index = uint32_t(options.frame),
        .count = true,
        .tile = options.tile,
        .aovs = {options.aovs.begin(), options.aovs.end()}};
    settings.lighting.ambient = options.ambient;
    const lab::Rendered rendered = lab::render(*device, scene, stage, choice, settings);
    demand_valid(*device);

    nlohmann::ordered_json json
        = {{"technique", lab::choice_text(choice)}, {"files", nlohmann::ordered_json::array()}, {"passes", nlohmann::ordered_json::array()},
            {"technique_ms", rendered.technique_ms}, {"bytes", rendered.technique_bytes}, {"warnings", stage.scene.warnings}};
    write_picture(file, rendered.radiance, lab::display(rendered.radiance, stage, options.exposure), base::Encoding::srgb);
    json["files"].push_back(file.string());
    for (const auto& [name, picture] : rendered.aovs) {
        fs::path aov = file;
        aov.replace_extension(name + file.extension().string());
        write_picture(aov, picture, lab::aov_display(name, picture), name == "albedo" ? base::Encoding::srgb : base::Encoding::linear);
        json["files"].push_back(aov.string());
    }
    for (const lab::PassStats& pass : rendered.passes)
        json["passes"].push_back({{"name", pass.name}, {"ms", pass.ms}, {"deviation", pass.deviation}});
    if (!rendered.counts.empty()) json["counts"] = rendered.counts;
    if (options.common.json)
        fmt::print("{}\n", json.dump(1));
    else {
        for (const lab::PassStats& pass : rendered.passes) fmt::print("{:<32} {:>9.2f} ms\n", pass.name, pass.ms);
        for (const auto& [name, count] : rendered.counts) fmt::print("{:<32} {:>9}\n", name, count);
        for (const auto& f : json["files"]) fmt::print("{}\n", f.get<std::string>());
    }
    return 0;
}

} // namespace gnomon::cli
