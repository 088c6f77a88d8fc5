// SPDX-License-Identifier: Apache-2.0
#include "lab/folder.h"

#include "base/error.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <optional>

namespace gnomon::lab {

namespace fs = std::filesystem;

fs::path project_root()
{
    if (const char* given = std::getenv("GNOMON_ROOT")) {
        if (!fs::is_directory(fs::path(given) / "techniques"))
            base::fail("GNOMON_ROOT is '{}', which holds no folder techniques/; set it to a checkout of Gnomon", given);
        return given;
    }
    for (fs::path at = fs::current_path(); !at.empty(); at = at.parent_path()) {
        if (fs::is_directory(at / "techniques" / "_template")) return at;
        if (at == at.root_path()) break;
    }
    base::fail("this folder is not inside a checkout of Gnomon; change into one or set GNOMON_ROOT");
}

std::vector<std::string> claimed_kinds(const shadow::TechniqueInfo& info)
{
    std::vector<std::string> out;
    for (int k = 0; k < scene::light_kind_count; ++k)
        if (info.lights & (1u << k)) out.emplace_back(scene::kind_name(scene::LightKind(k)));
    return out;
}

Stage technique_stage(const TechniqueScene& own, const std::string& kind, base::Size size)
{
    const auto light = own.lights.find(kind);
    if (light == own.lights.end())
        base::fail("scene.json names no light of kind {}, which the technique claims; add \"{}\" to its \"lights\"", kind, kind);
    Stage stage = open_stage({own.scene, {.detail = own.detail}, own.camera, {light->second}, size});
    if (scene::kind_name(stage.lights.front().kind()) != kind)
        base::fail("scene.json: the light '{}' is {}, not {}", light->second, scene::kind_name(stage.lights.front().kind()), kind);
    return stage;
}

Choice technique_choice(const shadow::TechniqueInfo& info, const TechniqueScene& own)
{
    Choice choice{&info, shadow::ParamValues(info.params())};
    choice.params.set_json(nlohmann::ordered_json::parse(own.params));
    return choice;
}

PromiseReport check_promises(
    gpu::Device& device, const shadow::TechniqueInfo& info, const fs::path& folder, base::Size size, const fs::path& truth_cache)
{
    const TechniqueScene own = read_technique_scene(folder);
    const Choice choice = technique_choice(info, own);
    PromiseReport out;
    for (const std::string& kind : claimed_kinds(info)) {
        const Stage stage = technique_stage(own, kind, size);
        shadow::SceneGpu scene(device, stage.scene);
        Run run = new_run(stage, choice, kind);
        const truth::Reference truth = truth::reference(
            stage.scene, stage.view, stage.lights.front(), {.samples = own.truth_samples}, truth_quantity(choice), truth_cache);
        const Rendered rendered = render(device, scene, stage, choice, {.repeats = 1, .lit = false, .aovs = scored_aovs});
        std::optional<FilterReference> filter;
        if (!own.reference.empty()) filter = filter_reference(device, scene, stage, own.reference);
        score(stage, stage.lights.front(), truth, rendered, run, {.filter = filter ? &*filter : nullptr});
        const auto promise = own.promise.find(kind);
        if (promise == own.promise.end())
            base::fail("{}: no promise for {} lights, which the technique claims", (folder / "scene.json").string(), kind);
        for (const auto& [metric, bound] : promise->second) {
            const auto measured = run.metrics.find(metric);
            if (measured == run.metrics.end())
                base::fail(
                    "{}: the promise names '{}', which is not measured for {} lights here", (folder / "scene.json").string(), metric, kind);
            // a NaN is a broken promise too
            if (!(measured->second <= bound)) out.broken.push_back({kind, metric, bound, measured->second});
        }
        out.runs.push_back(std::move(run));
    }
    return out;
}

} // namespace gnomon::lab
