// SPDX-License-Identifier: Apache-2.0
#include "lab/stage.h"

#include "base/error.h"
#include "scene/rebase.h"

#include <charconv>

namespace gnomon::lab {

void check_size(base::Size size)
{
    if (size.width < 1 || size.height < 1 || size.width > 16384 || size.height > 16384)
        base::fail("a picture of {}x{} pixels cannot be made; each side takes 1 to 16384", size.width, size.height);
}

Stage open_stage(const StageOptions& options)
{
    check_size(options.size);
    Stage stage;
    stage.scene = scene::load(options.scene, options.load);
    stage.scene_name = stage.scene.name.empty() ? options.scene : stage.scene.name;
    stage.origin = options.origin.value_or(scene::far_origin(stage.scene));
    scene::rebase(stage.scene, stage.origin);
    stage.bounds = stage.scene.bounds();
    aim_stage(stage, options);
    return stage;
}

void aim_stage(Stage& stage, const StageOptions& options)
{
    check_size(options.size);
    stage.lights.clear();
    if (options.camera.empty())
        stage.camera = stage.scene.cameras.empty() ? scene::fit_camera(stage.bounds) : stage.scene.cameras.front();
    else
        stage.camera = scene::parse_camera(options.camera, stage.scene.cameras, stage.bounds, stage.origin);
    for (const std::string& text : options.lights)
        stage.lights.push_back(scene::parse_light(text, stage.scene.lights, stage.bounds, stage.origin));
    for (const scene::Light& light : stage.scene.lights)
        if (stage.lights.empty() && (options.kinds & (1u << unsigned(light.kind())))) stage.lights.push_back(light);
    if (stage.lights.empty()) stage.lights.push_back(scene::parse_light("directional,elevation=50,azimuth=35,angle=0", {}, stage.bounds));
    stage.view = scene::make_view(stage.camera, options.size, stage.bounds);
}

base::Size parse_size(const std::string& text)
{
    base::Size size;
    const char* end = text.data() + text.size();
    const auto [cross, first] = std::from_chars(text.data(), end, size.width);
    if (first != std::errc() || cross == end || *cross != 'x') base::fail("a size is WIDTHxHEIGHT in pixels, as 640x360, not '{}'", text);
    const auto [last, second] = std::from_chars(cross + 1, end, size.height);
    if (second != std::errc() || last != end) base::fail("a size is WIDTHxHEIGHT in pixels, as 640x360, not '{}'", text);
    check_size(size);
    return size;
}

} // namespace gnomon::lab
