// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/bias.h"

#include "shadow/parts/fit.h"
#include "src/shadow/parts/bias.shared.h"

#include <cstddef>

namespace gnomon::shadow::parts {

namespace {

/// Of polygon offset, a texel of the filter's width. Half a texel's slope would do for a plane whose slope lies along one axis of the map.
constexpr float slope_factor = 0.75f;

gpu::ImageId between_layers(gpu::PassList& passes, const LightMap& first, gpu::ImageId second, const shaders::BiasParams& bias, float reach)
{
    const gpu::ImageDesc desc = passes.desc(first.depth);
    const gpu::ImageId depth = passes.transient(desc);
    const uint32_t layers = desc.layers;
    gpu::RasterPass pass;
    pass.name = "layers";
    pass.program = &passes.device().raster_program("shaders/fullscreen_layers.vert", "src/shadow/parts/bias_layers.frag");
    pass.bindings = {gpu::Binding(first.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
        gpu::Binding(second, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
    pass.constants = with_map(
        shaders::BiasLayersConstants{first.constants, bias.constant, bias.scale * reach, bias.kind == BIAS_DUAL_LAYERS ? 1u : 0u}, first,
        offsetof(shaders::BiasLayersConstants, map));
    pass.depth = gpu::DepthTarget{depth};
    pass.layers = layers;
    pass.draw = [layers](gpu::Encoder& encoder) { encoder.draw(3, layers); };
    passes.raster(std::move(pass));
    return depth;
}

} // namespace

void describe_bias(Fields& fields, shaders::BiasParams& p, bool ids)
{
    std::vector<std::string> kinds
        = {"constant", "slope", "normal_offset", "receiver_plane", "cone", "texel_world", "second_depth", "midpoint", "dual_layers"};
    if (ids) kinds.push_back("ids");
    fields.choice(
        "bias", p.kind, std::move(kinds), "What keeps surfaces from shadowing themselves; docs/bias.md describes and measures each.");
    fields.real("bias_constant", p.constant, {0, 100}, "m",
        "Depth by which a receiver is moved towards the light; midpoint, dual_layers: by which the map's first surface is moved away from "
        "it.");
    fields.real("bias_scale", p.scale, {0, 64}, "",
        "Times what the kind takes by itself, which follows the texel's width, the filter's and the surface's slope.");
}

LightMap draw_biased_map(
    gpu::PassList& passes, const Frame& frame, const LightMapSettings& wanted, const shaders::BiasParams& bias, float reach)
{
    LightMapSettings settings = wanted;
    if (bias.kind == BIAS_SLOPE) settings.slope_bias = slope_factor * bias.scale * 2.0f * reach;
    // across the map, d / L times sin(a)
    if (bias.kind == BIAS_NORMAL_OFFSET) settings.offset_texels = 1.4143f * bias.scale * reach;
    // second layers and ids are drawn by corners, which paraboloids bend
    if (bias.kind >= BIAS_MIDPOINT && PointLayout(settings.fitting.point_layout) == PointLayout::dual_paraboloid)
        settings.fitting.point_layout = int(PointLayout::cube);
    if (bias.kind == BIAS_SECOND_DEPTH) settings.cull = VK_CULL_MODE_FRONT_BIT;
    if (bias.kind != BIAS_MIDPOINT && bias.kind != BIAS_DUAL_LAYERS) return draw_light_map(passes, frame, settings);
    settings.format = DepthFormat::d32;
    LightMap map = draw_light_map(passes, frame, settings);
    const gpu::ImageId second = peel_light_map(passes, frame, map, settings, map.depth);
    map.depth = between_layers(passes, map, second, bias, reach);
    return map;
}

gpu::ImageId draw_light_ids(gpu::PassList& passes, const Frame& frame, const LightMap& map, const LightMapSettings& settings)
{
    gpu::ImageDesc desc = passes.desc(map.depth);
    const gpu::ImageId depth = passes.transient(desc);
    desc.format = VK_FORMAT_R32_UINT, desc.name = "light ids";
    const gpu::ImageId ids = passes.transient(desc);
    const std::string shader = map.constants.layers[0].warped != 0 ? "src/shadow/parts/light_ids_warped" : "src/shadow/parts/light_ids";
    const auto program = [&](bool masked) -> const gpu::Program& {
        const gpu::SpecConstant spec[] = {{0, masked ? 1u : 0u}};
        return passes.device().raster_program(shader + ".vert", shader + ".frag", spec);
    };
    gpu::RasterPass pass;
    pass.name = "light ids";
    pass.program = &program(false);
    pass.constants = caster_constants(map.constants, 0.0f, map.fitted);
    pass.colors = {{ids, gpu::Load::clear, {.uint32 = {~0u}}}};
    pass.depth = gpu::DepthTarget{depth};
    draw_casters(passes, frame, map.constants, settings, std::move(pass), program(true));
    return ids;
}

gpu::Buffer instance_starts(gpu::Device& device, const scene::Scene& scene)
{
    std::vector<uint32_t> words = scene.first_primitives();
    words.insert(words.begin(), uint32_t(words.size()));
    gpu::Buffer buffer
        = device.buffer({words.size() * sizeof(uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Memory::device, "starts"});
    device.upload(buffer, std::as_bytes(std::span(words)));
    return buffer;
}

} // namespace gnomon::shadow::parts
