// SPDX-License-Identifier: Apache-2.0
#include "lab/export.h"

#include "base/error.h"
#include "gpu/reflect.h"
#include "lab/export_impl.h"
#include "scene/light.h"

#include <algorithm>

namespace gnomon::lab {

namespace {

/// Content of images and buffers by name.
using Contents = std::map<std::string, std::string>;

std::string to_string(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// What the passes read of the technique's own that none of them has written: it came from the CPU, or from the frame before.
Contents read_contents(gpu::Device& device, const Recording& r, const Json& resources)
{
    Contents out;
    for (uint32_t i = 0; i < r.list.buffers.size(); ++i)
        if (resources["buffers"].contains(r.buffers[i]) && resources["buffers"][r.buffers[i]].contains("needs_content"))
            out["buffer " + r.buffers[i]] = to_string(device.read_back(*r.list.buffers[i].imported));
    for (uint32_t i = 0; i < r.list.images.size(); ++i) {
        if (!resources["images"].contains(r.images[i]) || !resources["images"][r.images[i]].contains("needs_content")) continue;
        const auto& parts = r.list.images[i].imported->state().parts;
        if (std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.layout == VK_IMAGE_LAYOUT_UNDEFINED; })) continue;
        std::string& bytes = out["image " + r.images[i]];
        const gpu::ImageDesc& d = r.list.images[i].desc;
        for (uint32_t mip = 0; mip < d.mips; ++mip)
            for (uint32_t layer = 0; layer < d.layers; ++layer)
                bytes += to_string(device.read_back_bytes(*r.list.images[i].imported, layer, mip));
    }
    return out;
}

/// What an export knows of a frame.
struct Recorded {
    Json resources, passes;

    std::vector<std::vector<std::byte>> constants;
    Contents contents;
};

/// Records frames of one technique object and describes each before it runs.
class Recorder {
public:
    Recorder(gpu::Device& device, const Stage& stage, const Choice& choice)
        : device_(device)
        , stage_(stage)
        , choice_(choice)
        , scene_(device, stage.scene)
        , technique_(choice.info->create(device))
    {
    }

    Recorded record(uint32_t index, std::vector<UsedShader>& shaders, bool submit)
    {
        const scene::Light& light = stage_.lights.front();
        const VkFormat format = shadow::output_format(*choice_.info, choice_.params.bytes(), light);
        gpu::PassList passes(device_);
        const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene_, stage_.view);
        const gpu::ImageId output = passes.transient(
            {format, stage_.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, std::string(output_name(output_of(choice_)))});
        const shadow::Frame frame{stage_.scene, stage_.view, light, scene_, g, output, index};
        passes.group(std::string(choice_.info->id));
        technique_->record(passes, frame, choice_.params.bytes());
        const Recording r(passes, frame, choice_.info->id);
        Recorded out{describe_resources(r), describe_passes(r, shaders), {}, {}};
        for (const gpu::Pass* pass : r.passes) {
            const gpu::Constants* constants = constants_of(*pass);
            out.constants.push_back(constants ? constants->bytes : std::vector<std::byte>());
        }
        out.contents = read_contents(device_, r, out.resources);
        if (submit) device_.submit(std::move(passes));
        return out;
    }

private:
    gpu::Device& device_;
    const Stage& stage_;
    const Choice& choice_;
    shadow::SceneGpu scene_;
    std::unique_ptr<shadow::Technique> technique_;
};

std::string file_stem(const std::string& shader) { return shader.substr(shader.rfind('/') + 1); }

std::string_view extension(Language language)
{
    constexpr std::string_view extensions[] = {".glsl", ".hlsl", ".metal", ".spv"};
    return extensions[size_t(language)];
}

Json parameters_json(const Choice& choice)
{
    const Json values = choice.params.json(), defaults = default_choice(*choice.info).params.json();
    Json out = Json::array();
    for (const shadow::ParamInfo& p : choice.params.table().fields) {
        Json entry = {{"name", p.name}, {"value", values[p.name]}, {"default", defaults[p.name]}, {"unit", p.unit}, {"help", p.help}};
        if (!p.choices.empty()) entry["choices"] = p.choices;
        out.push_back(std::move(entry));
    }
    return out;
}

/// Translates the shaders, and puts what they say of themselves into the recipe.
void add_shaders(const std::vector<UsedShader>& shaders, Language language, Json& recipe, Exported& out)
{
    recipe["shaders"] = Json::object();
    recipe["types"] = Json::object();
    std::map<std::string, std::string> sources;
    for (const UsedShader& shader : shaders) {
        const std::span<const uint32_t> words = gpu::find_shader(shader.name).spirv;
        const std::map<std::string, std::string> own = sources_of(words, shader.name);
        sources.insert(own.begin(), own.end());
        Json reflection = reflect_shader(shader, words, own, recipe["types"]);
        for (Json& resource : reflection["resources"]) resource["place"] = place_of(language, resource);
        Translation translation = translate(language, shader, words, reflection);
        const std::string stem = file_stem(shader.name), file = stem + std::string(extension(language));
        reflection["source"] = "source/" + shader.name + ".glsl";
        if (translation.refusal.empty()) {
            reflection["file"] = file;
            out.files.emplace_back(file, std::move(translation.text));
        } else {
            reflection["refused"] = translation.refusal;
            out.refused.emplace_back(stem, translation.refusal);
        }
        if (recipe["shaders"].contains(stem)) throw std::logic_error("two shaders of one technique have the file name " + stem);
        recipe["shaders"][stem] = std::move(reflection);
    }
    for (auto& [path, text] : sources) out.files.emplace_back("source/" + path, std::move(text));
}

const Json* constants_block(const Json& recipe, const Json& pass)
{
    for (const Json& program : pass["programs"])
        for (const Json& shader : program["shaders"])
            for (const Json& resource : recipe["shaders"][shader.get<std::string>()]["resources"])
                if (resource["set"] == 1) return &resource;
    return nullptr;
}

void add_constants(Json& recipe, Json& passes, const std::vector<std::vector<std::byte>>& constants)
{
    for (size_t i = 0; i < passes.size(); ++i) {
        if (!passes[i].contains("constants")) continue;
        const Json* block = constants_block(recipe, passes[i]);
        if (!block) continue;
        passes[i]["constants"]["place"] = (*block)["place"];
        passes[i]["constants"]["members"] = (*block)["members"];
        passes[i]["constants"]["values"] = decode_block(constants[i], (*block)["members"], recipe["types"]);
    }
}

/// What is the same for another scene belongs to the technique and is exported; the rest follows from the scene.
void add_contents(gpu::Device& device, const Stage& stage, const Choice& choice, const Contents& contents, Json& recipe, Exported& out)
{
    if (contents.empty()) return;
    Stage other = open_stage({.scene = "stacked", .size = stage.view.size});
    other.lights = stage.lights;
    std::vector<UsedShader> unused;
    const Contents theirs = Recorder(device, other, choice).record(0, unused, false).contents;
    for (const auto& [name, bytes] : contents) {
        const auto twin = theirs.find(name);
        if (twin == theirs.end() || twin->second != bytes) continue;
        const bool image = name.starts_with("image ");
        const std::string own = name.substr(name.find(' ') + 1);
        std::string file = "data/" + own + ".bin";
        std::replace(file.begin(), file.end(), ' ', '_');
        recipe[image ? "images" : "buffers"][own]["data"] = file;
        out.files.emplace_back(file, bytes);
    }
}

/// Passes of the first frame that the later ones lack, or run on other targets or with other shaders.
Json only_in_first(const Json& first, const Json& later)
{
    const auto same = [](const Json& a, const Json& b) {
        for (const char* key : {"name", "programs", "colors", "depth", "value"})
            if (a.value(key, Json()) != b.value(key, Json())) return false;
        return true;
    };
    Json out = Json::array();
    for (const Json& pass : first)
        if (std::none_of(later.begin(), later.end(), [&](const Json& p) { return same(pass, p); })) out.push_back(pass);
    return out;
}

} // namespace

Exported export_technique(gpu::Device& device, const Stage& stage, const Choice& choice, Language language)
{
    const shadow::TechniqueInfo& info = *choice.info;
    const scene::Light& light = stage.lights.front();
    if (const std::string reason = shadow::refusal(info, device, light); !reason.empty()) base::fail("{}", reason);
    Json recipe = {{"generator", "gnomon " GNOMON_VERSION_TEXT}, {"format", 1},
        {"technique", {{"id", info.id}, {"title", info.title}, {"cite", info.cite}, {"output", output_name(output_of(choice))}}},
        {"language", language_name(language)}, {"light", scene::kind_name(light.kind())}, {"scene", stage.scene_name},
        {"view", {stage.view.size.width, stage.view.size.height}}, {"temporal", info.temporal}, {"parameters", parameters_json(choice)}};
    std::vector<UsedShader> shaders;
    Recorder recorder(device, stage, choice);
    Recorded frame = recorder.record(0, shaders, info.temporal);
    Json first = Json::array();
    Contents contents = frame.contents;
    if (info.temporal) {
        Recorded second = recorder.record(1, shaders, false);
        first = only_in_first(frame.passes, second.passes);
        frame = std::move(second);
    }
    recipe["images"] = std::move(frame.resources["images"]);
    recipe["buffers"] = std::move(frame.resources["buffers"]);
    Exported out;
    add_shaders(shaders, language, recipe, out);
    add_contents(device, stage, choice, contents, recipe, out);
    add_constants(recipe, frame.passes, frame.constants);
    recipe["passes"] = std::move(frame.passes);
    if (!first.empty()) recipe["first_frame"] = std::move(first);
    out.files.emplace_back("layouts.h", layout_header(recipe["types"]));
    out.files.emplace_back("passes.json", recipe.dump(1) + "\n");
    out.files.emplace_back("README.md", readme(recipe));
    return out;
}

} // namespace gnomon::lab
