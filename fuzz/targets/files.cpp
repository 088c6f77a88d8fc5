// SPDX-License-Identifier: Apache-2.0
// Gnomon's own files: scenes and lists of them, experiments, figures, presets, techniques' scenes, lines of results, and kept truth.
#include "base/image_file.h"
#include "base/line_file.h"
#include "fuzz/sound.h"
#include "fuzz/target.h"
#include "lab/experiment.h"
#include "lab/figures.h"
#include "lab/folder.h"
#include "lab/preset.h"
#include "lab/sweep.h"
#include "scene/animation.h"
#include "scene/load.h"
#include "truth/cache.h"

using namespace gnomon;

namespace {

/// What an input may name: a model and images for lights.
void write_companions()
{
    fuzz::write(
        "model.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0},
        "material":0}]}],"materials":[{"name":"leaves"}],"accessors":[{"bufferView":0,"type":"VEC3","componentType":5126,"count":3}],"bufferViews":[{"buffer":0,
        "byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    base::Picture picture({3, 2}, 3, 0.5f);
    base::write_png(fuzz::folder() / "light.png", picture, base::Encoding::srgb);
    base::write_exr(fuzz::folder() / "light.exr", picture, {"R", "G", "B"});
}

void read_scene(const std::filesystem::path& file)
{
    fuzz::accepts([&] {
        const scene::Scene scene = scene::load(file.string());
        fuzz::demand(scene::unsound(scene).empty(), scene::unsound(scene));
        const std::string text = scene::scene_json_text(scene, "model.gltf");
        fuzz::write("again.json", text);
        // What Gnomon writes it reads: but names may be of any form, and images are not written.
        const scene::Scene again = scene::load((fuzz::folder() / "again.json").string());
        fuzz::demand(again.lights.size() >= scene.lights.size() && again.cameras.size() >= scene.cameras.size(), "a scene file comes back");
    });
    fuzz::accepts([&] { scene::animation_seconds(file.string()); });
    fuzz::accepts([&] { scene::convert_scene_list(file, "models"); });
}

/// Every line alone, so that one bad line does not keep the others from being read; then all columns of those that are results.
void read_results(const std::filesystem::path& file)
{
    lab::Results results;
    size_t number = 0;
    for (const std::string& line : base::read_lines(file)) fuzz::accepts([&] { results.add(line, file, ++number); });
    fuzz::accepts([&] { results.demand_device("device", "driver", file); });
    const lab::Cell cell{.choice = lab::parse_choice("stand_in")};
    for (const auto& [key, line] : results.all()) {
        const lab::Row row{&cell, &line};
        for (const std::string& column : lab::number_columns()) row.number(column);
        row.number("pass:light map+res*");
        row.number("count:tile_tests");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    static const bool once = (write_companions(), true);
    fuzz::demand(once, "the companions are there");
    const std::string_view text = fuzz::text_of(data, size);
    const std::filesystem::path file = fuzz::write("scene.json", text);
    read_scene(file);
    fuzz::accepts([&] {
        const lab::Experiment experiment = lab::read_experiment(file);
        fuzz::demand(!experiment.cells.empty() && !experiment.tables.empty(), "an experiment has combinations and a table");
        for (const lab::Cell* cell : lab::distinct_runs(experiment)) fuzz::demand(!cell->key.empty(), "a run has a key");
    });
    fuzz::accepts([&] { lab::read_figures(file); });
    fuzz::accepts([&] { lab::parse_choice(lab::choice_text(lab::read_preset_choice(file))); });
    fuzz::accepts([&] {
        const lab::TechniqueScene scene = lab::read_technique_scene(fuzz::folder());
        lab::default_choice(shadow::technique("stand_in")).params.set_json(nlohmann::ordered_json::parse(scene.params));
    });
    read_results(file);
    fuzz::write("kept.truth", text);
    truth::load(fuzz::folder(), "kept", {4, 3}, 1);
    return 0;
}
