// SPDX-License-Identifier: Apache-2.0
#include "lab/folder.h"

#include "base/error.h"
#include "base/file.h"
#include "base/image_file.h"
#include "base/progress.h"
#include "metrics/metrics.h"
#include "scene/load.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::lab {

namespace fs = std::filesystem;

namespace {

/// Panels beside one another; all linear display-referred RGB.
base::Picture beside(const std::vector<base::Picture>& panels)
{
    int width = -picture_gap, height = 0;
    for (const base::Picture& p : panels) width += p.size.width + picture_gap, height = std::max(height, p.size.height);
    base::Picture out({width, height}, 3, 1.0f);
    int left = 0;
    for (const base::Picture& p : panels) {
        for (int y = 0; y < p.size.height; ++y)
            for (int x = 0; x < p.size.width; ++x)
                for (int c = 0; c < 3; ++c) out.at(left + x, y, c) = p.at(x, y, std::min(c, p.channels - 1));
        left += p.size.width + picture_gap;
    }
    return out;
}

/// A display-encoded picture (a heat map) as the linear one that the sRGB writer gives back.
base::Picture decoded(base::Picture p)
{
    for (float& v : p.values) v = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    return p;
}

} // namespace

fs::path make_picture(gpu::Device& device, const shadow::TechniqueInfo& info, const fs::path& folder)
{
    const TechniqueScene own = read_technique_scene(folder);
    const Choice choice = technique_choice(info, own);
    Comparison comparison;
    comparison.device = device.info().name, comparison.driver = device.info().driver, comparison.commit = commit();
    std::vector<base::Picture> panels;
    for (const std::string& kind : claimed_kinds(info)) {
        const Stage stage = technique_stage(own, kind, picture_panel);
        shadow::SceneGpu scene(device, stage.scene);
        Run run = new_run(stage, choice, kind);
        const truth::Reference truth
            = truth::reference(stage.scene, stage.view, stage.lights.front(), {.samples = own.truth_samples}, truth_quantity(choice));
        const Rendered rendered = render(device, scene, stage, choice, {.repeats = 5, .count = true, .aovs = scored_aovs});
        std::optional<FilterReference> filter;
        if (!own.reference.empty()) filter = filter_reference(device, scene, stage, own.reference);
        base::Picture heat;
        score(stage, stage.lights.front(), truth, rendered, run, {.filter = filter ? &*filter : nullptr, .heat_map = &heat});
        add_times(run, rendered);
        comparison.runs.push_back(std::move(run));
        if (!panels.empty()) continue;
        panels = {display(rendered.radiance, stage), display(shade_with(device, scene, stage, {truth.visibility.mean}, {}), stage),
            decoded(heat)};
    }
    base::write_text(folder / "results.json", results_json(comparison).dump(1) + "\n");
    const fs::path file = folder / (std::string(info.id) + ".png");
    base::write_png(file, beside(panels), base::Encoding::srgb);
    return file;
}

std::vector<fs::path> make_scene_pictures(gpu::Device& device, const fs::path& root)
{
    const bool ray_traced = shadow::technique("ray_traced").unavailable(device).empty();
    std::vector<fs::path> files;
    base::Progress progress("scenes", scene::builtins().size());
    for (const scene::Builtin& builtin : scene::builtins()) {
        StageOptions options{.scene = std::string(builtin.name), .size = {320, 180}};
        if (!ray_traced) options.kinds = shadow::technique("shadow_map").lights;
        const Stage stage = open_stage(options);
        shadow::SceneGpu scene(device, stage.scene);
        const Rendered rendered
            = render(device, scene, stage, parse_choice(ray_traced ? "ray_traced:samples=4" : "shadow_map:map_size=4096"), {.samples = 9});
        files.push_back(root / "docs" / "pictures" / (std::string(builtin.name) + ".png"));
        base::write_png(files.back(), display(rendered.radiance, stage), base::Encoding::srgb);
        progress.advance();
    }
    return files;
}

} // namespace gnomon::lab
