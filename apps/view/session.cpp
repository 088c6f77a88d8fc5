// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include "base/error.h"
#include "scene/animation.h"
#include "scene/rebase.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace gnomon::view {

namespace {

constexpr double slow
    = 80; // ms: slower pictures are drawn coarser while something moves; with the panel, the window then keeps 10 a second

constexpr double patient = 4000; // ms: a first picture that took longer is not drawn twice for its times

lab::Choice first_choice(const Options& options)
{
    lab::Choice choice = lab::parse_choice(options.technique);
    for (const std::string& item : options.parameters) {
        const size_t equals = item.find('=');
        choice.params.set(item.substr(0, equals), equals == std::string::npos ? "" : std::string_view(item).substr(equals + 1));
    }
    return choice;
}

} // namespace

Session::Session(gpu::Device& device, const Options& options, std::function<void()> wake)
    : left(first_choice(options))
    , right(left)
    , ambient(options.ambient)
    , device_(device)
    , wake_(std::move(wake))
    , size_(options.stage.size)
{
    look.exposure = options.exposure;
    lab::StageOptions stage = options.stage;
    stage.kinds = left.info->lights;
    load(stage);
    if (options.against == "truth")
        against = Against::truth;
    else if (!options.against.empty())
        right = lab::parse_choice(options.against), against = Against::technique;
}

void Session::attempt(const std::function<void()>& action)
{
    try {
        action();
    } catch (const std::exception& e) {
        message = {e.what(), true};
    }
}

void Session::load(const lab::StageOptions& options, bool same_file)
{
    auto loaded = std::make_unique<Loaded>();
    loaded->stage = lab::open_stage(options);
    loaded->scene = std::make_unique<shadow::SceneGpu>(device_, loaded->stage.scene);
    loaded->picture = std::make_unique<Picture>(device_, *loaded->scene);
    loaded->truth = std::make_unique<TruthWorker>(loaded->stage.scene, wake_);
    std::vector<LightOrigin> origins;
    const lab::Stage& stage = loaded->stage;
    for (size_t i = 0; i < stage.lights.size(); ++i)
        origins.push_back(i < options.lights.size() ? light_origin(options.lights[i], stage.scene.lights)
                                                    : light_origin(stage.lights[i], stage.scene.lights, stage.bounds, stage.origin));
    std::vector<std::string> lights;
    for (size_t i = 0; i < stage.lights.size(); ++i) lights.push_back(light_text(stage.lights[i], origins[i], stage.origin));
    const double duration = same_file ? duration_ : scene::animation_seconds(options.scene);
    // Nothing has thrown: the new scene takes the old one's place.
    truth_.reset(), truth_key_.clear();
    loaded_ = std::move(loaded);
    options_ = options, duration_ = duration;
    origins_ = std::move(origins), lights_ = std::move(lights);
    camera_ = camera_text(loaded_->stage.camera, loaded_->stage.origin);
    if (!loaded_->stage.scene.warnings.empty()) message = {loaded_->stage.scene.warnings.front(), false};
    for (size_t i = 0; i < lights_.size(); ++i) light(i, lights_[i]);
    camera(camera_);
}

void Session::open(const std::string& scene)
{
    lab::StageOptions options = options_;
    options.scene = scene, options.camera.clear(), options.lights.clear(), options.kinds = left.info->lights, options.size = size_;
    if (options_.scene != scene) options.load.time = 0;
    load(options);
}

void Session::time(double seconds)
{
    if (seconds == options_.load.time) return;
    lab::StageOptions options = options_;
    options.load.time = seconds, options.camera = camera_, options.lights = lights_, options.size = size_;
    load(options, true);
}

void Session::technique(const std::string& id)
{
    const shadow::TechniqueInfo& info = shadow::technique(id);
    kept_.insert_or_assign(std::string(left.info->id), left.params);
    const auto found = kept_.find(id);
    left = {&info, found == kept_.end() ? shadow::ParamValues(info.params()) : found->second};
    times.clear(), time_order.clear();
    timed = 0;
}

void Session::compare_with(Against what, const std::string& id)
{
    if (what == Against::technique) right = lab::parse_choice(id);
    against = what;
}

void Session::camera(const std::string& text)
{
    lab::Stage& stage = loaded_->stage;
    const scene::Camera parsed = scene::parse_camera(text, stage.scene.cameras, stage.bounds, stage.origin);
    scene::make_view(parsed, size_, stage.bounds); // throws where it is none
    stage.camera = parsed;
    camera_ = camera_text(parsed, stage.origin);
}

void Session::camera(const scene::Camera& wanted) { camera(camera_text(wanted, loaded_->stage.origin)); }

void Session::light(size_t index, const std::string& text)
{
    lab::Stage& stage = loaded_->stage;
    const scene::Light parsed = scene::parse_light(text, stage.scene.lights, stage.bounds, stage.origin);
    const LightOrigin origin = light_origin(text, stage.scene.lights);
    const std::string words = light_text(parsed, origin, stage.origin);
    stage.lights.at(index) = scene::parse_light(words, stage.scene.lights, stage.bounds, stage.origin);
    lights_.at(index) = words, origins_.at(index) = origin;
}

void Session::light(size_t index, const scene::Light& wanted)
{
    light(index, light_text(wanted, origins_.at(index), loaded_->stage.origin));
}

void Session::size(base::Size wanted)
{
    lab::check_size(wanted);
    size_ = wanted;
}

void Session::reset_parameters() { left.params = shadow::ParamValues(left.info->params()); }

void Session::inspect_next()
{
    const int offers = int(picture().overlays().offers().size());
    overlays.inspect = overlays.inspect < 0 ? 0 : overlays.inspect + 1 < offers ? overlays.inspect + 1 : -1;
}

void Session::aim(base::Size size)
{
    lab::Stage& stage = loaded_->stage;
    stage.view = scene::make_view(stage.camera, size, stage.bounds);
}

Wish Session::wish() const
{
    const bool map = left.info->output == shadow::Output::visibility || left.info->output == shadow::Output::transmittance;
    OverlayWish wanted = overlays;
    wanted.footprint = map && look.show >= 10;
    return {.stage = loaded_->stage,
        .left = left,
        .right = against == Against::technique ? &right : nullptr,
        .truth = truth_.get(),
        .against_truth = against == Against::truth,
        .ambient = ambient,
        .overlays = wanted};
}

bool Session::wants_coarse(bool moving) const { return moving && coarse_while_moving && full_ms_ > slow && size_.area() > 128 * 128; }

std::shared_ptr<const TruthWorker::Result> Session::current_truth() const
{
    const auto newest = loaded_->truth->newest();
    return newest && newest->key == truth_key_ ? newest : nullptr;
}

void Session::ask_for_truth(bool moving)
{
    if (against != Against::truth || moving) {
        loaded_->truth->rest();
        truth_key_.clear(), truth_.reset();
        return;
    }
    TruthWorker::Wish wanted;
    wanted.view = loaded_->stage.view, wanted.lights = loaded_->stage.lights, wanted.quantity = truth::Quantity::visibility;
    if (lab::output_of(left) == shadow::Output::transmittance) wanted.quantity = truth::Quantity::transmittance;
    wanted.key = view_key(loaded_->stage) + lights_key(loaded_->stage) + std::to_string(int(wanted.quantity));
    truth_key_ = wanted.key;
    loaded_->truth->want(wanted);
    truth_ = current_truth();
}

void Session::add_times(double ms)
{
    std::map<std::string, double> sums; // passes of one name are one line
    const auto add = [&](const std::vector<gpu::PassTime>& list) {
        for (const gpu::PassTime& t : list) {
            if (t.name.starts_with("keep ") || t.name.starts_with("overlay/") || t.name.find("/inspect ") != std::string::npos) continue;
            if (!times.count(t.name) && !sums.count(t.name)) time_order.push_back(t.name);
            sums[t.name] += t.ms;
        }
    };
    add(picture().receiver_times());
    add(picture().left().times);
    // The first picture also makes pipelines: the second takes its place.
    const double share = timed <= 1 ? 1.0 : std::max(1.0 / timed, 0.1);
    for (const auto& [name, sum] : sums) {
        double& mean = times.emplace(name, sum).first->second;
        mean += share * (sum - mean);
    }
    draw_ms += share * (ms - draw_ms);
    ++timed;
}

void Session::update(bool moving)
{
    const bool was_coarse = coarse_;
    coarse_ = wants_coarse(moving);
    aim(coarse_ ? base::Size{std::max(size_.width / 2, 1), std::max(size_.height / 2, 1)} : size_);
    ask_for_truth(moving);
    const auto begin = std::chrono::steady_clock::now();
    const Wish wanted = wish();
    const bool drawn = picture().draw(wanted);
    picture().compose(wanted, look);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    drawn_ms = ms;
    if (!drawn || was_coarse != coarse_) return;
    add_times(ms);
    if (!coarse_) full_ms_ = ms;
    if (timed == 1 && ms < patient) picture().draw_again();
}

std::string Session::reload_shaders()
{
    const std::vector<CompiledShader> compiled = shaders_.compile_changed();
    if (compiled.empty()) return "no shader has changed";
    for (const CompiledShader& shader : compiled) device_.replace_shader(shader.name, shader.spirv);
    shaders_.taken();
    picture().forget();
    return fmt::format(
        "recompiled {}{}", compiled.front().name, compiled.size() > 1 ? fmt::format(" and {} more", compiled.size() - 1) : std::string());
}

std::string Session::standing_error() const
{
    if (!picture().left().error.empty()) return picture().left().error;
    if (against != Against::nothing && !picture().right().error.empty()) return picture().right().error;
    return truth_ ? truth_->error : std::string();
}

int Session::truth_samples() const { return truth_ ? truth_->samples : 0; }
bool Session::truth_finished() const { return truth_ && truth_->finished; }

bool Session::truth_moved() const
{
    const auto newest = current_truth();
    return newest && newest != truth_;
}

std::string Session::command() const
{
    return render_command({options_.scene, options_.load, camera_, lights_, size_, look.exposure, ambient}, left);
}

} // namespace gnomon::view
