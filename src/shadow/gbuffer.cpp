// SPDX-License-Identifier: Apache-2.0
#include "shadow/gbuffer.h"

#include "shadow/light_constants.h"
#include "shadow/scene_gpu.h"
#include "src/shadow/gbuffer.shared.h"

namespace gnomon::shadow {

namespace {

GBuffer make_images(gpu::PassList& passes, SceneGpu& scene, const scene::View& view, const GBufferRequest& request)
{
    const auto image = [&](VkFormat format, const char* name) {
        return passes.transient({format, view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, name});
    };
    GBuffer g;
    g.depth = image(VK_FORMAT_D32_SFLOAT, "depth");
    g.normal = image(VK_FORMAT_R32G32_UINT, "normal");
    g.primitive = image(VK_FORMAT_R32_UINT, "primitive");
    if (request.material) {
        g.albedo = image(VK_FORMAT_R8G8B8A8_SRGB, "albedo");
        g.surface = image(VK_FORMAT_R8G8B8A8_UNORM, "surface");
        if (scene.emits()) g.emissive = image(VK_FORMAT_R16G16B16A16_SFLOAT, "emissive");
    }
    if (request.previous) g.motion = image(VK_FORMAT_R32G32_SFLOAT, "motion");
    return g;
}

/// Where each visible point was one frame ago: the same triangles again, where their depth is the picture's.
void draw_motion(gpu::PassList& passes, SceneGpu& scene, const GBuffer& g, const scene::View& view, const scene::View& previous)
{
    gpu::RasterPass pass;
    pass.name = "motion";
    pass.program = &scene.device().raster_program("src/shadow/motion.vert", "src/shadow/motion.frag");
    pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.previous_instances()), gpu::Use::load}};
    pass.constants = shaders::GBufferConstants{view_constants(view, 0), previous.clip_from_world};
    pass.colors = {{g.motion}};
    pass.depth = gpu::DepthTarget{.image = g.depth, .load = gpu::Load::keep, .write = false, .compare = VK_COMPARE_OP_EQUAL};
    pass.streams = {SceneGpu::position_stream(), SceneGpu::previous_stream()};
    pass.draw = [&scene, planes = frustum_planes(view.clip_from_world)](gpu::Encoder& encoder) {
        scene.draw(
            encoder, {.sets = draw_opaque | draw_masked, .cull = &planes, .cull_back_faces = true, .second = SceneGpu::Second::previous});
    };
    passes.raster(std::move(pass));
}

} // namespace

GBuffer draw_gbuffer(gpu::PassList& passes, SceneGpu& scene, const scene::View& view, const GBufferRequest& request)
{
    const GBuffer g = make_images(passes, scene, view, request);
    gpu::Device& device = scene.device();
    const auto program = [&](uint32_t with_mask) -> const gpu::Program& {
        const gpu::SpecConstant constants[] = {{0, with_mask}, {1, request.material ? 1u : 0u}, {2, request.flat ? 1u : 0u}};
        return device.raster_program("src/shadow/gbuffer.vert", "src/shadow/gbuffer.frag", constants);
    };
    const gpu::Program &opaque = program(0), &masked = program(1);

    gpu::RasterPass pass;
    pass.name = "gbuffer";
    pass.program = &opaque;
    pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load}};
    pass.constants = shaders::GBufferConstants{view_constants(view, 0), mat4(1)};
    pass.textures = &scene.textures();
    VkClearColorValue nothing{};
    nothing.uint32[0] = 0xffffffffu;
    pass.colors = {{g.normal}, {g.primitive, gpu::Load::clear, nothing}, {g.albedo}, {g.surface}, {g.emissive}};
    pass.depth = gpu::DepthTarget{g.depth};
    pass.streams = {SceneGpu::position_stream(), SceneGpu::attribute_stream()};
    pass.draw = [&scene, &masked, planes = frustum_planes(view.clip_from_world)](gpu::Encoder& encoder) {
        scene.draw(encoder, {.sets = draw_opaque, .cull = &planes, .cull_back_faces = true, .second = SceneGpu::Second::attributes});
        if (!scene.has(draw_masked)) return;
        encoder.program(masked);
        scene.draw(encoder, {.sets = draw_masked, .cull = &planes, .cull_back_faces = true, .second = SceneGpu::Second::attributes});
    };
    passes.raster(std::move(pass));
    if (request.previous) draw_motion(passes, scene, g, view, *request.previous);
    return g;
}

} // namespace gnomon::shadow
