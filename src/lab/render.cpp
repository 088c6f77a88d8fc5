// SPDX-License-Identifier: Apache-2.0
#include "lab/render.h"

#include "base/error.h"
#include "lab/aov.h"
#include "lab/render_tiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace gnomon::lab {

namespace {

using namespace shadow;

/// Radical inverse: the jitter of supersampling.
float halton(int index, int radix)
{
    float value = 0, fraction = 1;
    for (; index > 0; index /= radix) {
        fraction /= float(radix);
        value += fraction * float(index % radix);
    }
    return value;
}

/// One recorded picture: persistent copies of what is read back afterwards.
struct Targets {
    std::vector<gpu::Image> images; ///< the technique's, one a light
    gpu::Image radiance, primitive;
};

gpu::Image make_image(gpu::Device& device, VkFormat format, base::Size size, const char* name)
{
    return device.image({format, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
}

std::vector<uint32_t> words(const std::vector<std::byte>& bytes)
{
    std::vector<uint32_t> out(bytes.size() / 4);
    memcpy(out.data(), bytes.data(), out.size() * 4);
    return out;
}

class Renderer {
public:
    /// `crop`: only this part of the stage's picture.
    Renderer(gpu::Device& device, SceneGpu& scene, const Stage& stage, const Choice& choice, const RenderSettings& settings,
        const scene::Crop* crop = nullptr)
        : device_(device)
        , scene_(scene)
        , stage_(stage)
        , choice_(choice)
        , settings_(settings)
        , camera_(stage.camera)
        , crop_(crop)
    {
        const base::Size size = crop ? crop->size : stage.view.size;
        for (const scene::Light& light : stage.lights) {
            const std::string reason = refusal(*choice.info, device, light);
            if (!reason.empty()) base::fail("{}", reason);
            techniques_.push_back(choice.info->create(device));
            targets_.images.push_back(
                make_image(device, output_format(*choice.info, choice.params.bytes(), light), size, "technique's image"));
        }
        targets_.primitive = make_image(device, VK_FORMAT_R32_UINT, size, "primitive copy");
        if (settings.lit) targets_.radiance = make_image(device, VK_FORMAT_R32G32B32A32_SFLOAT, size, "radiance copy");
    }

    void look_from(const scene::Camera& camera) { camera_ = camera; }
    scene::View view(vec2 jitter = vec2(0)) const { return scene::make_view(camera_, stage_.view.size, stage_.bounds, jitter, crop_); }

    gpu::Submitted draw(vec2 jitter, uint32_t frame, AovCopies* aovs, std::vector<Counter>* counters = nullptr)
    {
        if (settings_.stop.stop_requested()) base::fail("rendering was stopped before its last frame; nothing of it is kept");
        const scene::View view = this->view(jitter);
        gpu::PassList passes(device_);
        const GBuffer g = draw_gbuffer(
            passes, scene_, view, {.material = settings_.lit || aovs, .previous = aovs && aovs->wants("motion") ? &view : nullptr});
        std::vector<ShadowedLight> shadowed;
        for (size_t i = 0; i < stage_.lights.size(); ++i) {
            const gpu::ImageId output = passes.import(targets_.images[i]);
            passes.group(std::string(choice_.info->id));
            parts::LightMap map{};
            techniques_[i]->record(
                passes, Frame{stage_.scene, view, stage_.lights[i], scene_, g, output, frame, &map, counters}, choice_.params.bytes());
            passes.group("");
            if (i == 0 && aovs && aovs->wants_footprint()) {
                if (map.constants.layer_count == 0)
                    base::fail("{} looks its shadows up in no light map whose texels could be shown", choice_.info->id);
                aovs->record_footprint(passes, g, view, map);
            }
            shadowed.push_back({&stage_.lights[i], output});
        }
        passes.copy(g.primitive, passes.import(targets_.primitive), "copy primitive");
        const Output output = output_of(choice_);
        const bool composited = output == Output::visibility || output == Output::transmittance;
        if (settings_.lit)
            passes.copy(shade(passes, scene_, g, view,
                            composited ? std::span<const ShadowedLight>(shadowed) : std::span<const ShadowedLight>(), settings_.lighting),
                passes.import(targets_.radiance), "copy radiance");
        if (aovs) aovs->record(passes, g);
        if (counters) copy_counters(passes, *counters);
        return device_.submit(std::move(passes));
    }

    /// Of a frame of its own, so that counting slows no timed one.
    std::map<std::string, uint64_t> count(uint32_t frame)
    {
        std::vector<Counter> counters;
        draw(vec2(0), frame, nullptr, &counters);
        std::map<std::string, uint64_t> out;
        if (counters.empty()) return out;
        const std::vector<uint32_t> values = words(device_.read_back(counted_));
        for (size_t i = 0; i < counters.size(); ++i) out[counters[i].name] += values[i];
        return out;
    }

    /// What the last frame left.
    void read(AovCopies& aovs, Rendered& out)
    {
        for (gpu::Image& image : targets_.images) out.images.push_back(device_.read_back(image));
        out.primitive = words(device_.read_back_bytes(targets_.primitive));
        out.aovs = aovs.read(device_, view(), stage_.origin);
        if (settings_.aovs.count("visibility")) out.aovs["visibility"] = out.images.front();
    }

    uint64_t kept_bytes() const
    {
        uint64_t bytes = 0;
        for (const auto& technique : techniques_) bytes += technique->kept_bytes();
        return bytes;
    }
    gpu::Image& radiance() { return targets_.radiance; }

private:
    void copy_counters(gpu::PassList& passes, const std::vector<Counter>& counters)
    {
        if (counters.empty()) return;
        counted_ = device_.buffer({counters.size() * 4, 0, gpu::Memory::read_back, "counters"});
        for (size_t i = 0; i < counters.size(); ++i)
            passes.copy(counters[i].buffer, passes.import(counted_), 4, counters[i].offset, i * 4, "copy counter");
    }

    gpu::Device& device_;
    SceneGpu& scene_;
    const Stage& stage_;
    const Choice& choice_;
    const RenderSettings& settings_;
    scene::Camera camera_;
    const scene::Crop* crop_;
    std::vector<std::unique_ptr<Technique>> techniques_;
    Targets targets_;
    gpu::Buffer counted_;
};

struct Sums {
    double sum = 0, squares = 0;
    double least = std::numeric_limits<double>::infinity();
    int count = 0;
    void add(double v) { sum += v, squares += v * v, least = std::min(least, v), ++count; }
    double mean() const { return count ? sum / count : 0; }
    double deviation() const { return count > 1 ? std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1))) : 0; }
};

double own_ms(const std::vector<gpu::PassTime>& frame, std::string_view id)
{
    const std::string own = std::string(id) + "/";
    double ms = 0;
    for (const gpu::PassTime& t : frame)
        if (t.name.starts_with(own)) ms += t.ms;
    return ms;
}

/// Passes of one name in one frame (several lights or layers) are added up.
void collect(Rendered& out, const std::vector<std::vector<gpu::PassTime>>& runs, std::string_view id)
{
    std::vector<std::string> names;
    std::map<std::string, Sums> sums;
    std::map<std::string, int> counts;
    Sums technique;
    for (const auto& run : runs) {
        std::map<std::string, double> frame;
        counts.clear();
        for (const gpu::PassTime& t : run) {
            if (std::find(names.begin(), names.end(), t.name) == names.end()) names.push_back(t.name);
            frame[t.name] += t.ms;
            ++counts[t.name];
        }
        for (const auto& [name, ms] : frame) sums[name].add(ms);
        technique.add(own_ms(run, id));
    }
    for (const std::string& name : names)
        if (!name.starts_with("copy ")) out.passes.push_back({name, sums[name].mean(), sums[name].deviation(), counts[name]});
    out.technique_ms = technique.mean(), out.technique_deviation = technique.deviation();
    out.technique_least_ms = technique.least;
}

void add_rgb(base::Picture& sum, const base::Picture& rgba, float weight)
{
    if (sum.empty()) sum = base::Picture(rgba.size, 3);
    for (size_t i = 0; i < rgba.size.area(); ++i)
        for (size_t c = 0; c < 3; ++c) sum.values[i * 3 + c] += weight * rgba.values[i * 4 + c];
}

Rendered render_part(
    gpu::Device& device, SceneGpu& scene, const Stage& stage, const Choice& choice, const RenderSettings& settings, const scene::Crop* crop)
{
    Rendered out;
    Renderer renderer(device, scene, stage, choice, settings, crop);
    AovCopies aovs(device, crop ? crop->size : stage.view.size, settings.aovs);
    // The first list makes pipelines and acceleration structures: it is timed only when it is the only one.
    const gpu::Submitted first = renderer.draw(vec2(0), settings.frame_index, &aovs);
    std::vector<std::vector<gpu::PassTime>> runs;
    const int warm_up = std::max(settings.warm_up, settings.repeats > 1 || settings.again ? 1 : 0);
    if (warm_up == 0) runs.push_back(first.times);
    for (int i = 1; i < warm_up; ++i) renderer.draw(vec2(0), settings.frame_index, nullptr);
    double least = std::numeric_limits<double>::infinity();
    const auto again = [&](int frames) { return settings.again && frames > 0 ? settings.again(frames, least) : frames < settings.repeats; };
    for (int i = 0; warm_up > 0 && again(i); ++i) {
        runs.push_back(renderer.draw(vec2(0), settings.frame_index, nullptr).times);
        least = std::min(least, own_ms(runs.back(), choice.info->id));
    }
    collect(out, runs, choice.info->id);
    const auto own = first.group_bytes.find(std::string(choice.info->id));
    out.technique_bytes = (own == first.group_bytes.end() ? 0 : own->second) + renderer.kept_bytes();

    if (settings.count && choice.info->counts) out.counts = renderer.count(settings.frame_index);

    renderer.read(aovs, out);
    for (int s = 0; settings.lit && s < settings.samples; ++s) {
        if (settings.samples > 1)
            renderer.draw(
                vec2(halton(s + 1, 2), halton(s + 1, 3)) - 0.5f, settings.frame_index * uint32_t(settings.samples) + uint32_t(s), nullptr);
        add_rgb(out.radiance, device.read_back(renderer.radiance()), 1.0f / float(settings.samples));
    }
    return out;
}

} // namespace

Rendered render(gpu::Device& device, SceneGpu& scene, const Stage& stage, const Choice& choice, const RenderSettings& settings)
{
    const base::Size size = stage.view.size;
    const int side = std::max(settings.tile, 1);
    if (size.width <= side && size.height <= side) return render_part(device, scene, stage, choice, settings, nullptr);
    Rendered whole;
    for (int top = 0; top < size.height; top += side)
        for (int left = 0; left < size.width; left += side) {
            const scene::Crop crop{left, top, {std::min(side, size.width - left), std::min(side, size.height - top)}};
            paste(whole, size, render_part(device, scene, stage, choice, settings, &crop), crop);
        }
    return whole;
}

std::vector<Rendered> render_sequence(gpu::Device& device, SceneGpu& scene, const Stage& stage, const Choice& choice,
    std::span<const scene::Camera> cameras, RenderSettings settings)
{
    settings.lit = false;
    std::vector<Rendered> out(cameras.size());
    Renderer renderer(device, scene, stage, choice, settings);
    AovCopies aovs(device, stage.view.size, settings.aovs);
    for (size_t i = 0; i < cameras.size(); ++i) {
        renderer.look_from(cameras[i]);
        for (int w = 0; i == 0 && w < settings.warm_up; ++w) renderer.draw(vec2(0), settings.frame_index, nullptr);
        renderer.draw(vec2(0), settings.frame_index + uint32_t(i), &aovs);
        renderer.read(aovs, out[i]);
    }
    return out;
}

base::Picture shade_with(
    gpu::Device& device, SceneGpu& scene, const Stage& stage, const std::vector<base::Picture>& images, const LightingSettings& settings)
{
    std::vector<gpu::Image> uploaded;
    for (const base::Picture& picture : images) {
        const bool colored = picture.channels == 3;
        uploaded.push_back(make_image(device, colored ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_SFLOAT, picture.size, "given image"));
        std::vector<float> texels = picture.values;
        if (colored) {
            texels.assign(picture.size.area() * 4, 1.0f);
            for (size_t i = 0; i < picture.size.area(); ++i) std::copy_n(&picture.values[i * 3], 3, &texels[i * 4]);
        }
        device.upload(uploaded.back(), std::as_bytes(std::span(texels)));
    }
    gpu::Image radiance = make_image(device, VK_FORMAT_R32G32B32A32_SFLOAT, stage.view.size, "radiance copy");
    gpu::PassList passes(device);
    const GBuffer g = draw_gbuffer(passes, scene, stage.view);
    std::vector<ShadowedLight> shadowed;
    for (size_t i = 0; i < images.size(); ++i) shadowed.push_back({&stage.lights[i], passes.import(uploaded[i])});
    passes.copy(shade(passes, scene, g, stage.view, shadowed, settings), passes.import(radiance), "copy radiance");
    device.submit(std::move(passes));
    base::Picture out;
    add_rgb(out, device.read_back(radiance), 1.0f);
    return out;
}

} // namespace gnomon::lab
