// SPDX-License-Identifier: Apache-2.0
#include "lab/sequence.h"

#include "base/error.h"
#include "metrics/comparison.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lab {

namespace {

/// Of all frames: truth, image and surfaces together take about 100 bytes a pixel.
constexpr size_t most_pixels = size_t(1) << 26;

float pixel_width(const scene::View& view, float depth)
{
    const float at_one = std::abs(2.0f / (view.clip_from_view[1][1] * float(view.size.height)));
    return view.orthographic ? at_one : at_one * depth;
}

base::Picture pixel_widths(const scene::View& view, const base::Picture& depth)
{
    base::Picture out(depth.size, 1);
    for (size_t i = 0; i < out.values.size(); ++i) out.values[i] = pixel_width(view, depth.values[i]);
    return out;
}

std::array<float, 2> pixel_of(const scene::View& view, std::array<float, 3> p)
{
    const vec4 clip = view.clip_from_world * vec4(p[0], p[1], p[2], 1.0f);
    if (!(clip.w > 0.0f)) return {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()};
    return {(0.5f + 0.5f * clip.x / clip.w) * float(view.size.width), (0.5f + 0.5f * clip.y / clip.w) * float(view.size.height)};
}

/// A pixel's width at what stands in the middle of the picture; where nothing does, at the middle of the scene.
float middle_pixel(const Stage& stage)
{
    const truth::Tracer tracer(stage.scene);
    const float hit = tracer.primary(scene::make_view(stage.camera, {1, 1}, stage.bounds)).depth.values.front();
    return pixel_width(stage.view, hit > 0.0f ? hit : glm::length(stage.bounds.centre() - stage.camera.eye));
}

bool same_shape(const scene::Scene& a, const scene::Scene& b)
{
    const auto same_instance
        = [](const scene::Instance& i, const scene::Instance& j) { return i.mesh == j.mesh && i.world_from_object == j.world_from_object; };
    const auto same_mesh = [](const scene::Mesh& i, const scene::Mesh& j) { return i.positions == j.positions; };
    return std::equal(a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(), same_instance)
        && std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(), same_mesh);
}

/// Puts a light into the stage while it lives.
class OtherLight {
public:
    OtherLight(Stage& stage, const scene::Light& light)
        : stage_(stage)
        , before_(stage.lights)
    {
        stage.lights = {light};
    }
    ~OtherLight() { stage_.lights = std::move(before_); }
    OtherLight(const OtherLight&) = delete;
    OtherLight& operator=(const OtherLight&) = delete;

private:
    Stage& stage_;
    std::vector<scene::Light> before_;
};

} // namespace

Sequence::Sequence(gpu::Device& device, shadow::SceneGpu& scene, Stage& stage, const StageOptions& options, const Motion& motion,
    const SequenceSettings& settings)
    : device_(device)
    , scene_(scene)
    , stage_(stage)
    , options_(options)
    , settings_(settings)
{
    const bool bare = motion.kind == Motion::Kind::camera && !motion.shift && !motion.turn;
    motion_ = with_steps(motion, stage.lights.front(), bare ? middle_pixel(stage) : 0.0f, stage.bounds.radius());
    if (stage.view.size.area() * size_t(motion_.frames) > most_pixels)
        base::fail(
            "{} frames of {}x{} pixels are more than a sequence takes (64 million pixels in all); give fewer frames or a smaller size",
            motion_.frames, stage.view.size.width, stage.view.size.height);
    if (motion_.kind == Motion::Kind::time) demand_animation();
}

/// The camera and the light stay those of the first frame, even where they were fitted to its bounds.
Stage Sequence::at_time(int frame) const
{
    StageOptions options = options_;
    options.load.time += double(frame) * *motion_.step;
    options.origin = stage_.origin;
    Stage out = open_stage(options);
    out.camera = stage_.camera, out.lights = stage_.lights;
    out.view = scene::make_view(out.camera, stage_.view.size, out.bounds);
    return out;
}

void Sequence::demand_animation() const
{
    for (int frame = 1; frame < motion_.frames; ++frame)
        if (!same_shape(stage_.scene, at_time(frame).scene)) return;
    base::fail("motion '{}': nothing of {} moves in that time; give a scene with an animation, or another motion: camera, light or still",
        motion_text(motion_), stage_.scene_name);
}

scene::View Sequence::view(int frame) const
{
    return motion_.kind == Motion::Kind::camera ? scene::make_view(moved(stage_.camera, motion_, frame), stage_.view.size, stage_.bounds)
                                                : stage_.view;
}

truth::Reference Sequence::trace(int frame, truth::Quantity quantity) const
{
    const truth::Settings settings{.samples = settings_.truth_samples};
    const scene::Light light = moved(stage_.lights.front(), motion_, frame);
    if (motion_.kind != Motion::Kind::time)
        return truth::reference(stage_.scene, view(frame), light, settings, quantity, settings_.truth_cache);
    const Stage now = at_time(frame);
    return truth::reference(now.scene, now.view, light, settings, quantity, settings_.truth_cache);
}

const std::vector<truth::Reference>& Sequence::truths(truth::Quantity quantity)
{
    std::vector<truth::Reference>& out = truths_[quantity];
    const int count = motion_.kind == Motion::Kind::still ? 1 : motion_.frames;
    while (int(out.size()) < count) out.push_back(trace(int(out.size()), quantity));
    return out;
}

std::vector<Rendered> Sequence::render_frames(const Choice& choice)
{
    RenderSettings settings{.frame_index = settings_.frame_index, .aovs = scored_aovs};
    std::vector<scene::Camera> cameras;
    for (int t = 0; t < motion_.frames; ++t) cameras.push_back(moved(stage_.camera, motion_, t));
    if (motion_.kind == Motion::Kind::camera || motion_.kind == Motion::Kind::still) {
        settings.warm_up = choice.info->temporal;
        return render_sequence(device_, scene_, stage_, choice, cameras, settings);
    }
    std::vector<Rendered> out;
    const scene::Light light = stage_.lights.front();
    for (int t = 0; t < motion_.frames; ++t, ++settings.frame_index) {
        const auto one = std::span(cameras).subspan(size_t(t), 1);
        if (motion_.kind == Motion::Kind::light) {
            const OtherLight other(stage_, moved(light, motion_, t));
            out.push_back(std::move(render_sequence(device_, scene_, stage_, choice, one, settings).front()));
        } else {
            const Stage now = at_time(t);
            shadow::SceneGpu scene(device_, now.scene);
            out.push_back(std::move(render_sequence(device_, scene, now, choice, one, settings).front()));
        }
    }
    return out;
}

void Sequence::measure(const Choice& choice, Run& run, base::Picture* map)
{
    const std::vector<truth::Reference>& traced = truths(truth_quantity(choice));
    const std::vector<Rendered> rendered = render_frames(choice);
    const bool hard = !stage_.lights.front().soft(), still = motion_.kind == Motion::Kind::still;
    const size_t count = rendered.size();
    std::vector<base::Picture> tests, widths;
    std::vector<std::vector<uint8_t>> masks;
    const base::Picture no_variance; // of one truth for all frames, whose errors cancel
    run.sequence = {.motion = motion_text(motion_)};
    for (size_t t = 0; t < count; ++t) {
        const truth::Reference& truth = traced[still ? 0 : t];
        tests.push_back(judged_channels(rendered[t].images.front(), truth.visibility.mean.channels));
        widths.push_back(pixel_widths(view(int(t)), truth.primary.depth));
        masks.push_back(score_mask(truth.primary, rendered[t]));
    }
    std::vector<metrics::SequenceFrame> frames;
    for (size_t t = 0; t < count; ++t) {
        const truth::Reference& truth = traced[still ? 0 : t];
        const metrics::Comparison shown{tests[t], truth.visibility.mean, still ? no_variance : truth.visibility.variance, masks[t], hard};
        frames.push_back({shown, truth.primary.position, truth.primary.normal, widths[t],
            [view = view(int(t))](std::array<float, 3> p) { return pixel_of(view, p); }});
        run.sequence.mae.push_back(metrics::mae(shown));
    }
    metrics::Temporal found = metrics::measure_sequence(frames, motion_.kind != Motion::Kind::camera);
    run.metrics["flicker"] = found.flicker, run.metrics["swimming"] = found.swimming, run.metrics["popping"] = found.popping;
    if (!hard) run.metrics["temporal_noise"] = found.noise;
    run.sequence.change = found.change;
    run.sequence.followed = found.followed, run.sequence.lost = found.lost, run.sequence.moved = found.moved;
    if (map) *map = std::move(found.map);
}

} // namespace gnomon::lab
