// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include "usage.h"

#include <fmt/format.h>

namespace gnomon::cli {

void add_common(CLI::App& app, Common& common, bool device)
{
    if (device) {
        app.add_option("--device", common.device, "Device to use: part of its name (default: the first GPU, else the software driver)");
        app.add_flag("--validation", common.validation, "Run under the Vulkan validation layers; errors end the run");
    }
    app.add_flag("--json", common.json, "Print the result as JSON");
}

void add_picture(CLI::App& app, Picture& picture, bool camera)
{
    app.add_option("scene", picture.scene, "A built-in scene (see `gnomon list --scenes`), a .glb or .gltf file, or a scene .json")
        ->required();
    if (camera) app.add_option("--camera", picture.camera, "A camera of the scene by name, or eye=x/y/z,target=x/y/z,fov=degrees, or fit");
    app.add_option("--light", picture.lights,
        "A light of the scene by name, or kind,key=value,... (sun,elevation=40,azimuth=120,angle=0.53); may be repeated");
    app.add_option("--size", picture.size, "Width and height in pixels, as 960x540")->capture_default_str();
    app.add_option("--time", picture.time, "Seconds into the scene's animation")->capture_default_str();
    app.add_option("--detail", picture.detail, "Triangle count of a built-in scene, times this")->capture_default_str();
    app.add_option("--gltf-scene", picture.gltf_scene, "Which scene of a glTF file (default: its own default)");
}

std::vector<std::string> technique_options(const CLI::App& app, const std::string& choice)
{
    std::vector<std::string> out;
    const std::vector<std::string> rest = app.remaining();
    if (rest.empty()) return out;
    const std::string technique = technique_id(choice);
    for (size_t i = 0; i < rest.size(); ++i) {
        const std::string& word = rest[i];
        if (word.rfind("--" + technique + ".", 0) != 0)
            refuse_words(app, {word}, fmt::format(" (parameters are given as --{}.NAME VALUE)", technique));
        std::string item = word.substr(3 + technique.size());
        if (item.find('=') == std::string::npos) {
            if (i + 1 >= rest.size()) throw UsageError(word + " needs a value");
            item += "=" + rest[++i];
        }
        out.push_back(item);
    }
    return out;
}

void add_slice(CLI::App& app, Slice& slice)
{
    add_picture(app, slice.picture, false);
    app.add_option("--technique", slice.technique, "Technique, by its id")->capture_default_str();
    app.add_option("--centre", slice.centre, "A point of the plane, x/y/z (default: the scene's centre)");
    app.add_option("--right", slice.right, "Direction that is right in the picture, x/y/z (default: level, towards the light)");
    app.add_option("--up", slice.up, "Direction that is up in it, x/y/z (default: 0/1/0)");
    app.add_option("--height", slice.height, "Metres from bottom to top (default: the scene fits)")->check(CLI::Range(0.0, 1e9));
    app.add_flag("--truth", slice.truth, "Also the ray-traced twin, and the difference to it");
    app.add_option("--truth-samples", slice.truth_samples, "Light samples a point of the truth")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    app.add_option(
        "-o,--output", slice.output, "PNG file; an EXR with the values is written beside it (default: out/SCENE.slice.TECHNIQUE.png)");
    app.allow_extras();
    add_common(app, slice.common);
}

void add_export(CLI::App& app, Export& what)
{
    app.add_option("technique", what.technique, "Technique, by its id; parameters may follow after colons, or @preset.json")->required();
    app.add_option("--to", what.language, "glsl (for Vulkan), hlsl (shader model 6.0), msl (2.4) or spirv")->required();
    app.add_option("-o,--output", what.output, "A new or empty folder, or an earlier export, which is replaced")->required();
    app.add_option("--light", what.light, "What it is recorded for: directional, spot, point, rect or disk, or a light with its keys");
    app.add_option("--set", what.set, "A parameter, as map_size=4096; may be repeated")->allow_extra_args(false);
    app.add_option("--scene", what.scene, "What it is recorded on: passes differ only where a scene lacks masked or emitting materials")
        ->capture_default_str();
    app.add_option("--size", what.size, "Of the view that it is recorded for")->capture_default_str();
    app.footer("Exit code 1, with the reason for each, where the language cannot say some of the shaders; all others are written.");
    add_common(app, what.common);
}

void add_look(CLI::App& app, float& exposure, float& ambient)
{
    app.add_option("--exposure", exposure, "Stops brighter or darker")->check(CLI::Range(-20.0, 20.0))->capture_default_str();
    app.add_option("--ambient", ambient, "Light from all around, relative to the lights")
        ->check(CLI::Range(0.0, 100.0))
        ->capture_default_str();
}

void add_view(CLI::App& app, View& view)
{
    add_picture(app, view.picture);
    app.add_option("--technique", view.technique, "Technique, by its id")->capture_default_str();
    app.add_option("--against", view.against, "What is shown on the right: truth, or a technique with parameters after colons");
    app.add_option("--state", view.state, "A JSON file that always says what the window shows and where its widgets are");
    app.add_option("--measure", view.measure, "Go around the camera's target in so many seconds, print pictures a second, and end")
        ->check(CLI::Range(0.1, 600.0));
    add_look(app, view.exposure, view.ambient);
    app.allow_extras();
    add_common(app, view.common);
}

} // namespace gnomon::cli
