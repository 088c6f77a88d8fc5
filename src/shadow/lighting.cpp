// SPDX-License-Identifier: Apache-2.0
#include "shadow/lighting.h"

#include "shadow/light_constants.h"
#include "src/shadow/lighting.shared.h"

#include <algorithm>

namespace gnomon::shadow {

namespace {

constexpr VkPipelineColorBlendAttachmentState blend(VkBlendFactor source, VkBlendFactor target)
{
    return {VK_TRUE, source, target, VK_BLEND_OP_ADD, source, target, VK_BLEND_OP_ADD, 0xf};
}

Ambient scaled_ambient(const LightingSettings& settings, float irradiance)
{
    Ambient a;
    a.sky *= settings.ambient * irradiance / pi, a.ground *= settings.ambient * irradiance / pi;
    return a;
}

void ambient_pass(
    gpu::PassList& passes, gpu::Device& device, const GBuffer& g, const scene::View& view, const Ambient& ambient, gpu::ImageId target)
{
    passes.fullscreen({.name = "ambient",
        .program = &device.raster_program("shaders/fullscreen.vert", "src/shadow/ambient.frag"),
        // without emission the slot still needs an image
        .bindings = {{g.depth, gpu::Use::sample}, {g.normal, gpu::Use::sample}, {g.albedo, gpu::Use::sample},
            {g.emissive ? g.emissive : g.albedo, gpu::Use::sample}},
        .constants = shaders::AmbientConstants{view_constants(view, 0), ambient.sky, g.emissive ? 1u : 0u, ambient.ground, 0},
        .colors = {{target, gpu::Load::discard}}});
}

void blended_pass(gpu::PassList& passes, SceneGpu& scene, const GBuffer& g, const scene::View& view, std::span<const ShadowedLight> lights,
    const Ambient& ambient, gpu::ImageId target)
{
    shaders::BlendedConstants constants{};
    constants.view = view_constants(view, 0), constants.sky = ambient.sky, constants.ground = ambient.ground;
    for (const ShadowedLight& l : lights)
        if (constants.light_count < BLENDED_MAX_LIGHTS)
            constants.lights[constants.light_count++] = light_constants(*l.light, scene.bounds());
    gpu::RasterPass pass;
    pass.name = "blended";
    pass.program = &scene.device().raster_program("src/shadow/blended.vert", "src/shadow/blended.frag");
    pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load}};
    pass.constants = constants;
    pass.textures = &scene.textures();
    pass.colors = {{.image = target, .load = gpu::Load::keep, .blend = blend(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA)}};
    pass.depth = gpu::DepthTarget{.image = g.depth, .load = gpu::Load::keep, .write = false};
    pass.streams = {SceneGpu::position_stream(), SceneGpu::attribute_stream()};
    pass.draw = [&scene, eye = view.eye, planes = frustum_planes(view.clip_from_world)](gpu::Encoder& encoder) {
        scene.draw(encoder,
            {.sets = draw_blended,
                .cull = &planes,
                .cull_back_faces = true,
                .second = SceneGpu::Second::attributes,
                .back_to_front_of = &eye});
    };
    passes.raster(std::move(pass));
}

} // namespace

float reference_irradiance(std::span<const scene::Light> lights, const Bounds& bounds)
{
    float largest = 0;
    for (const scene::Light& light : lights) {
        const shaders::Light l = light_constants(light, bounds);
        const float distance = glm::length(bounds.centre() - l.position);
        const float irradiance = std::max({l.radiance.x, l.radiance.y, l.radiance.z});
        const float reach = std::max(distance, 0.25f * bounds.radius());
        largest
            = std::max(largest, light.kind() == scene::LightKind::directional ? irradiance : irradiance / std::max(reach * reach, 1e-12f));
    }
    return largest > 0 ? largest : 1.0f;
}

gpu::ImageId shade(gpu::PassList& passes, SceneGpu& scene, const GBuffer& g, const scene::View& view, std::span<const ShadowedLight> lights,
    const LightingSettings& settings)
{
    gpu::Device& device = scene.device();
    std::vector<scene::Light> all;
    for (const ShadowedLight& l : lights) all.push_back(*l.light);
    const Ambient ambient = scaled_ambient(settings, reference_irradiance(all, scene.bounds()));
    const gpu::ImageId target
        = passes.transient({VK_FORMAT_R32G32B32A32_SFLOAT, view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "radiance"});
    ambient_pass(passes, device, g, view, ambient, target);
    const gpu::Program& program = device.raster_program("shaders/fullscreen.vert", "src/shadow/lighting.frag");
    for (const ShadowedLight& l : lights) {
        const bool colored = l.image && passes.desc(l.image).format == VK_FORMAT_R32G32B32A32_SFLOAT;
        passes.fullscreen({.name = "light",
            .program = &program,
            .bindings = {{g.depth, gpu::Use::sample}, {g.normal, gpu::Use::sample}, {g.albedo, gpu::Use::sample},
                {g.surface, gpu::Use::sample}, {l.image ? l.image : g.depth, gpu::Use::sample}},
            .constants = shaders::LightingConstants{view_constants(view, 0), light_constants(*l.light, scene.bounds()), l.image ? 1u : 0u,
                colored ? 1u : 0u},
            .colors = {{.image = target, .load = gpu::Load::keep, .blend = blend(VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE)}}});
    }
    if (scene.has(draw_blended)) blended_pass(passes, scene, g, view, lights, ambient, target);
    return target;
}

} // namespace gnomon::shadow
