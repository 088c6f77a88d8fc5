// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "base/error.h"
#include "base/image_file.h"
#include "lab/compare.h"
#include "lab/slice.h"
#include "scene/option_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace gnomon::cli {

namespace fs = std::filesystem;

namespace {

std::optional<vec3> parse_vector(const char* option, const std::string& text)
{
    if (text.empty()) return {};
    return scene::option_vec3({"slice", text, option}, text);
}

void write_both(
    const fs::path& exr, const base::Picture& image, const std::vector<std::array<vec2, 2>>& outline, nlohmann::ordered_json& files)
{
    base::write_exr(exr, image, image.channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
    fs::path png = exr;
    png.replace_extension(".png");
    base::write_png(png, lab::slice_display(image, outline), base::Encoding::linear);
    files.push_back(png.string());
    files.push_back(exr.string());
}

} // namespace

int slice(const Slice& options)
{
    lab::Choice choice = lab::parse_choice(options.technique);
    for (const std::string& item : options.parameters) {
        const size_t equals = item.find('=');
        choice.params.set(item.substr(0, equals), std::string_view(item).substr(equals + 1));
    }
    const lab::SliceOptions plane{.centre = parse_vector("--centre", options.centre),
        .right = parse_vector("--right", options.right),
        .up = parse_vector("--up", options.up),
        .height = options.height};
    lab::StageOptions stage_choice = stage_options(options.picture);
    stage_choice.kinds = choice.info->lights;
    lab::Stage stage = lab::open_stage(stage_choice);
    stage.lights.resize(1);
    const lab::Slice slice = lab::make_slice(stage, plane);
    const fs::path png = options.output.empty()
        ? fs::path("out") / fmt::format("{}.slice.{}.png", fs::path(options.picture.scene).stem().string(), choice.info->id)
        : fs::path(options.output);
    if (png.extension() != ".png") base::fail("'{}' is not a .png file; an .exr with the values is written beside it", png.string());
    fs::path exr = png;
    exr.replace_extension(".exr");

    const auto device = open_device(options.common);
    shadow::SceneGpu scene(*device, stage.scene);
    const base::Picture image = lab::slice_image(*device, scene, stage, slice, choice);
    demand_valid(*device);
    const auto outline = lab::slice_outline(stage.scene, slice);
    nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array()}};
    write_both(exr, image, outline, json["files"]);
    if (options.truth) {
        const base::Picture truth = lab::slice_truth(stage, slice, lab::truth_quantity(choice), options.truth_samples);
        fs::path twin = exr;
        write_both(twin.replace_extension(".truth.exr"), truth, outline, json["files"]);
        double sum = 0;
        for (size_t i = 0; i < truth.values.size(); ++i) sum += std::abs(double(image.values[i]) - double(truth.values[i]));
        json["mae"] = sum / double(truth.values.size());
    }
    if (options.common.json) {
        fmt::print("{}\n", json.dump(1));
        return 0;
    }
    for (const auto& f : json["files"]) fmt::print("{}\n", f.get<std::string>());
    if (options.truth) fmt::print("mean absolute difference to the truth: {:.5f}\n", json["mae"].get<double>());
    return 0;
}

} // namespace gnomon::cli
