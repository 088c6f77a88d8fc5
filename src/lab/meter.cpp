// SPDX-License-Identifier: Apache-2.0
#include "lab/meter.h"

#include "base/error.h"
#include "truth/cache.h"

namespace gnomon::lab {

struct Meter::Opened {
    Stage stage;
    std::optional<shadow::SceneGpu> scene; ///< made when something is measured first
};

struct Meter::Place {
    struct Judge {
        truth::Reference truth;
        std::vector<uint8_t> edge_band;
    };
    StageOptions options;
    Opened* opened;
    std::map<truth::Quantity, Judge> judges;
    FilterReference filter;
};

Meter::Meter(gpu::Device& device, MeterSettings settings)
    : device_(device)
    , settings_(std::move(settings))
{
    if (!settings_.reference.empty()) parse_choice(settings_.reference);
}

Meter::~Meter() = default;

size_t Meter::add(const StageOptions& options)
{
    const std::string text = fmt::format("{}\n{}\n{}\n{}", options.scene, options.load.time, options.load.detail, options.load.gltf_scene);
    auto& opened = scenes_[text];
    if (!opened) opened.reset(new Opened{open_stage(options), {}});
    places_.emplace_back(new Place{options, opened.get(), {}, {}});
    aim(places_.size() - 1); // what it names has to exist
    return places_.size() - 1;
}

size_t Meter::places() const { return places_.size(); }

Meter::Place& Meter::aim(size_t place)
{
    Place& out = *places_.at(place);
    aim_stage(out.opened->stage, out.options);
    out.opened->stage.lights.resize(1);
    return out;
}

const Stage& Meter::stage(size_t place) { return aim(place).opened->stage; }

std::string Meter::light_name(size_t place)
{
    const scene::Light& light = stage(place).lights.front();
    return light.name.empty() ? std::string(scene::kind_name(light.kind())) : light.name;
}

std::string Meter::key(size_t place)
{
    const Stage& at = stage(place);
    return truth::cache_key(at.scene, at.view, at.lights.front(), {.samples = settings_.truth_samples},
        settings_.quantity.value_or(truth::Quantity::visibility));
}

Run Meter::measure(size_t index, const Choice& choice, int repeats, const Again& again)
{
    Place& place = aim(index);
    Stage& stage = place.opened->stage;
    const scene::Light& light = stage.lights.front();
    if (const std::string reason = unmeasurable(choice, device_, light); !reason.empty()) base::fail("{}", reason);
    if (!place.opened->scene) place.opened->scene.emplace(device_, stage.scene);
    const truth::Quantity quantity = settings_.quantity.value_or(truth_quantity(choice));
    const auto [judge, fresh] = place.judges.try_emplace(quantity);
    if (fresh)
        judge->second.truth
            = truth::reference(stage.scene, stage.view, light, {.samples = settings_.truth_samples}, quantity, settings_.truth_cache);
    if (!settings_.reference.empty() && place.filter.choice.empty())
        place.filter = filter_reference(device_, *place.opened->scene, stage, settings_.reference);
    Run run = new_run(stage, choice, light_name(index));
    const Rendered rendered
        = render(device_, *place.opened->scene, stage, choice, {.repeats = repeats, .again = again, .lit = false, .aovs = scored_aovs});
    score(stage, light, judge->second.truth, rendered, run,
        {.filter = settings_.reference.empty() ? nullptr : &place.filter, .edge_band = &judge->second.edge_band});
    add_times(run, rendered);
    return run;
}

Run Meter::measure_time(size_t index, const Choice& choice, int repeats, const Again& again)
{
    Place& place = aim(index);
    Stage& stage = place.opened->stage;
    if (const std::string reason = shadow::refusal(*choice.info, device_, stage.lights.front()); !reason.empty()) base::fail("{}", reason);
    if (!place.opened->scene) place.opened->scene.emplace(device_, stage.scene);
    Run run = new_run(stage, choice, light_name(index));
    add_times(run, render(device_, *place.opened->scene, stage, choice, {.repeats = repeats, .again = again, .lit = false}));
    return run;
}

} // namespace gnomon::lab
