// SPDX-License-Identifier: Apache-2.0
#include "side.h"

#include "base/error.h"
#include "base/hash.h"

namespace gnomon::view {

namespace {

template <class T> std::string hex_of(const T& value) { return base::Hasher().bytes(std::as_bytes(std::span(&value, 1))).hex(); }

} // namespace

void fit_image(gpu::Device& device, gpu::Image& image, VkFormat format, base::Size size, const char* name)
{
    if (image && image.desc().format == format && image.desc().size == size) return;
    image = device.image({format, size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
}

std::string view_key(const lab::Stage& stage) { return hex_of(stage.view.clip_from_world) + hex_of(stage.view.size); }

std::string lights_key(const lab::Stage& stage)
{
    std::string key;
    for (const scene::Light& l : stage.lights) {
        key += fmt::format("{} {} {} ", int(l.kind()), hex_of(l.color), l.intensity.value_or(-1.0f));
        std::visit([&](const auto& shape) { key += hex_of(shape); }, l.shape);
        for (const vec3& texel : l.image.texels) key += hex_of(texel);
    }
    return key;
}

std::vector<gpu::PassTime> Receivers::draw(gpu::Device& device, shadow::SceneGpu& scene, const scene::View& view)
{
    gpu::PassList passes(device);
    const shadow::GBuffer g = shadow::draw_gbuffer(passes, scene, view);
    const std::pair<gpu::ImageId, gpu::Image*> kept[] = {{g.depth, &depth}, {g.normal, &normal}, {g.primitive, &primitive},
        {g.albedo, &albedo}, {g.surface, &surface}, {g.emissive, &emissive}};
    for (const auto& [id, image] : kept) {
        if (!id) continue;
        const gpu::ImageDesc desc = passes.desc(id);
        fit_image(device, *image, desc.format, desc.size, desc.name.c_str());
        passes.copy(id, passes.import(*image), "keep receivers");
    }
    return device.submit(std::move(passes)).times;
}

shadow::GBuffer Receivers::import(gpu::PassList& passes)
{
    shadow::GBuffer g;
    g.depth = passes.import(depth), g.normal = passes.import(normal), g.primitive = passes.import(primitive);
    g.albedo = passes.import(albedo), g.surface = passes.import(surface);
    if (emissive) g.emissive = passes.import(emissive);
    return g;
}

void Side::forget()
{
    key_.clear(), techniques_key_.clear();
    techniques_.clear();
}

void Side::make_techniques(gpu::Device& device, const lab::Stage& stage, const lab::Choice& choice)
{
    const std::string key = std::string(choice.info->id) + " " + lights_key(stage);
    if (key == techniques_key_) return;
    techniques_key_.clear();
    techniques_.clear();
    for (const scene::Light& light : stage.lights) {
        const std::string reason = shadow::refusal(*choice.info, device, light);
        if (!reason.empty()) base::fail("{}", reason);
        techniques_.push_back(choice.info->create(device));
    }
    techniques_key_ = key, frame_ = 0;
}

void Side::fit(gpu::Device& device, const lab::Stage& stage, const std::vector<VkFormat>& formats)
{
    const bool same = radiance && radiance.desc().size == stage.view.size && visibility.size() == formats.size();
    if (!same) valid = false;
    visibility.resize(formats.size());
    for (size_t i = 0; i < formats.size(); ++i) fit_image(device, visibility[i], formats[i], stage.view.size, "side's visibility");
    fit_image(device, radiance, VK_FORMAT_R32G32B32A32_SFLOAT, stage.view.size, "side's radiance");
}

void Side::shade(
    gpu::PassList& passes, shadow::SceneGpu& scene, const shadow::GBuffer& g, const lab::Stage& stage, float ambient, bool shadowed)
{
    std::vector<shadow::ShadowedLight> lights;
    for (size_t i = 0; shadowed && i < stage.lights.size(); ++i) lights.push_back({&stage.lights[i], passes.import(visibility[i])});
    passes.copy(shadow::shade(passes, scene, g, stage.view, lights, {.ambient = ambient}), passes.import(radiance), "keep radiance");
}

void Side::record(gpu::Device& device, shadow::SceneGpu& scene, Receivers& receivers, const lab::Stage& stage, const lab::Choice& choice,
    float ambient, Overlays* overlays)
{
    make_techniques(device, stage, choice);
    std::vector<VkFormat> formats;
    for (const scene::Light& light : stage.lights) formats.push_back(shadow::output_format(*choice.info, choice.params.bytes(), light));
    fit(device, stage, formats);
    gpu::PassList passes(device);
    const shadow::GBuffer g = receivers.import(passes);
    // Only what keeps something between frames may know of time: all else is to look as `gnomon render` draws it.
    const uint32_t frame = choice.info->temporal ? frame_++ : 0;
    for (size_t i = 0; i < stage.lights.size(); ++i) {
        shadow::parts::LightMap map{};
        passes.group(std::string(choice.info->id));
        shadow::Frame recorded{stage.scene, stage.view, stage.lights[i], scene, g, passes.import(visibility[i]), frame, &map};
        const bool overlaid = i == 0 && overlays;
        if (overlaid) recorded.inspections = overlays->inspections();
        techniques_[i]->record(passes, recorded, choice.params.bytes());
        passes.group("overlay");
        if (overlaid) overlays->record(passes, recorded, map, formats[i] == VK_FORMAT_R32G32B32A32_SFLOAT);
        passes.group("");
    }
    const shadow::Output output = lab::output_of(choice);
    shade(passes, scene, g, stage, ambient, output == shadow::Output::visibility || output == shadow::Output::transmittance);
    times = device.submit(std::move(passes)).times;
    valid = true;
}

bool Side::draw(gpu::Device& device, shadow::SceneGpu& scene, Receivers& receivers, const lab::Stage& stage, const lab::Choice& choice,
    float ambient, const std::string& key, Overlays* overlays)
{
    if (key == key_) return false;
    key_ = key; // also where it fails: the same would fail again
    error.clear();
    try {
        record(device, scene, receivers, stage, choice, ambient, overlays);
    } catch (const std::exception& e) {
        error = e.what();
        techniques_key_.clear();
    }
    return true;
}

bool Side::draw(gpu::Device& device, shadow::SceneGpu& scene, Receivers& receivers, const lab::Stage& stage,
    const std::vector<base::Picture>& images, float ambient, const std::string& key)
{
    if (key == key_) return false;
    key_ = key;
    techniques_key_.clear(), techniques_.clear();
    error.clear();
    try {
        std::vector<VkFormat> formats;
        for (const base::Picture& image : images)
            formats.push_back(image.channels == 1 ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT);
        fit(device, stage, formats);
        for (size_t i = 0; i < images.size(); ++i) {
            std::vector<float> texels = images[i].values;
            if (images[i].channels == 3) {
                texels.assign(images[i].size.area() * 4, 1.0f);
                for (size_t p = 0; p < images[i].size.area(); ++p) std::copy_n(&images[i].values[p * 3], 3, &texels[p * 4]);
            }
            device.upload(visibility[i], std::as_bytes(std::span(texels)));
        }
        gpu::PassList passes(device);
        shade(passes, scene, receivers.import(passes), stage, ambient, true);
        times = device.submit(std::move(passes)).times;
        valid = true;
    } catch (const std::exception& e) {
        error = e.what();
    }
    return true;
}

} // namespace gnomon::view
