// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/hash.h"
#include "lab/experiment_expand.h"
#include "truth/cache.h"

#include <fmt/format.h>

namespace gnomon::lab {

std::string scene_text(const Cell& c)
{
    return fmt::format("{}\n{}\n{}\n{}", c.stage.scene, c.stage.load.time, c.stage.load.detail, c.stage.load.gltf_scene);
}

std::string stage_text(const Cell& c)
{
    return fmt::format(
        "{}\n{}\n{}\n{}x{}", scene_text(c), c.stage.camera, fmt::join(c.stage.lights, "\n"), c.stage.size.width, c.stage.size.height);
}

void open_stages(Experiment& out)
{
    Stage stage;
    std::string opened, aimed, key;
    for (Cell& cell : out.cells) {
        if (scene_text(cell) != opened) {
            stage = open_stage(cell.stage);
            if (stage.scene.tuning || stage.scene.validation)
                base::fail("{0} is a scene for {1}, which published tables may not use; name one without \"{1}\": true", cell.stage.scene,
                    stage.scene.tuning ? "tuning" : "validation");
            opened = scene_text(cell), aimed.clear();
        }
        if (stage_text(cell) != aimed) {
            aim_stage(stage, cell.stage);
            aimed = stage_text(cell);
            key = truth::cache_key(
                stage.scene, stage.view, stage.lights.front(), {.samples = out.truth_samples}, truth::Quantity::visibility);
        }
        const scene::Light* light = &stage.lights.front();
        cell.key = key;
        if (cell.columns["camera"].empty()) cell.columns["camera"] = stage.camera.name.empty() ? "fit" : stage.camera.name;
        if (cell.columns["light"].empty())
            cell.columns["light"] = light->name.empty() ? std::string(scene::kind_name(light->kind())) : light->name;
    }
}

void finish_keys(Experiment& out)
{
    for (Cell& cell : out.cells) {
        base::Hasher h;
        h.text("run 1").text(cell.key).text(cell.choice.info->id).text(cell.choice.params.json().dump());
        h.text(cell.reference ? cell.reference->info->id : "").text(cell.reference ? cell.reference->params.json().dump() : "");
        h.value(out.truth_samples).value(out.warm_up).value(out.repeats).value(out.frame_index).value(out.flip);
        // named only where there is one: runs without keep the keys that they had before there were motions
        if (!cell.motion.empty()) h.text("motion 1").text(cell.motion);
        // what the truth does not feel, colours, is seen by FLIP
        if (out.flip) h.text(stage_text(cell));
        cell.key = h.hex();
    }
}

} // namespace gnomon::lab
