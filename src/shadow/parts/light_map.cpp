// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/cull.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sdsm.h"

#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/light_depth.shared.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <stdexcept>

namespace gnomon::shadow::parts {

namespace {

const std::vector<std::string> fit_names{"uniform", "focused", "cascades", "psm", "lispsm", "tsm", "cascades_warped", "sdsm"};

shaders::LightDepthConstants depth_constants(const shaders::LightMap& map, float slope_bias)
{
    shaders::LightDepthConstants c{};
    for (uint32_t i = 0; i < map.layer_count; ++i) {
        const shaders::LightMapLayer& layer = map.layers[i];
        c.clip_from_world[i] = clip_from_world(layer);
        c.depth_planes[i] = layer.depth_plane;
        c.ranges[i] = {layer.near, layer.far, float(layer.perspective), slope_bias};
    }
    return c;
}

gpu::ImageDesc depth_image(const shaders::LightMap& map, const LightMapSettings& settings)
{
    const VkFormat format = settings.format == DepthFormat::d16 ? VK_FORMAT_D16_UNORM : VK_FORMAT_D32_SFLOAT;
    return {format, {settings.size, settings.size}, map.layer_count, 1, VK_SAMPLE_COUNT_1_BIT, false, "light map"};
}

} // namespace

namespace {

/// The bytes of `part` are to be found at `offset`: else a pass that lays out its constants otherwise would be overwritten.
gpu::Constants patched(gpu::Constants constants, gpu::BufferId source, std::span<const std::byte> part, size_t source_offset, size_t offset)
{
    if (offset + part.size() > constants.bytes.size() || !std::equal(part.begin(), part.end(), constants.bytes.begin() + ptrdiff_t(offset)))
        throw std::logic_error("with_map: the constants do not hold the light map at this offset");
    constants.patches.push_back({source, uint32_t(source_offset), uint32_t(offset), uint32_t(part.size())});
    return constants;
}

} // namespace

gpu::Constants with_map(gpu::Constants constants, const LightMap& map, size_t offset)
{
    if (!map.fitted) return constants;
    return patched(
        std::move(constants), map.fitted, std::as_bytes(std::span(&map.constants, 1)), offsetof(shaders::FittedMap, map), offset);
}

gpu::Constants with_layer(gpu::Constants constants, const LightMap& map, uint32_t layer, size_t offset)
{
    if (!map.fitted) return constants;
    const size_t at = offsetof(shaders::FittedMap, map) + offsetof(shaders::LightMap, layers) + layer * sizeof(shaders::LightMapLayer);
    return patched(std::move(constants), map.fitted, std::as_bytes(std::span(&map.constants.layers[layer], 1)), at, offset);
}

mat4 clip_from_world(const shaders::LightMapLayer& layer)
{
    // map_from_world gives uv; the rasteriser wants clip coordinates
    static const mat4 clip_from_map = glm::scale(mat4(1), vec3(2, 2, 1)) * glm::translate(mat4(1), vec3(-0.5f, -0.5f, 0));
    return clip_from_map * layer.map_from_world;
}

Planes caster_planes(const shaders::LightMapLayer& layer)
{
    Planes planes = frustum_planes(clip_from_world(layer));
    if (layer.perspective == 0 || layer.warped != 0) planes.pop_back();
    if (layer.perspective != 0 && layer.warped != 0) planes.push_back(layer.depth_plane - vec4(0, 0, 0, layer.near));
    return planes;
}

gpu::Constants caster_constants(const shaders::LightMap& map, float slope_bias, gpu::BufferId fitted)
{
    gpu::Constants constants = depth_constants(map, slope_bias);
    if (fitted)
        constants.patches = {{fitted, offsetof(shaders::FittedMap, clip_from_world),
            offsetof(shaders::LightDepthConstants, clip_from_world), sizeof(shaders::FittedMap::clip_from_world)}};
    return constants;
}

void draw_casters(gpu::PassList& passes, const Frame& frame, const shaders::LightMap& map, const LightMapSettings& settings,
    gpu::RasterPass pass, const gpu::Program& masked, gpu::BufferId commands)
{
    SceneGpu& scene = frame.resources;
    const gpu::Program& opaque = *pass.program;
    const gpu::Binding casters[] = {{passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load}};
    pass.bindings.insert(pass.bindings.begin(), std::begin(casters), std::end(casters));
    pass.textures = &scene.textures();
    pass.layers = map.layer_count;
    pass.cull = settings.cull;
    // of warped layers nothing is clipped in depth but what lies behind the projection: w < 0
    pass.depth_clamp = map.layers[0].perspective == 0 && map.layers[0].warped == 0;
    pass.depth_bias = settings.slope_bias != 0.0f;
    pass.streams = {SceneGpu::position_stream(), SceneGpu::attribute_stream()};
    if (commands) pass.buffers = {{commands, gpu::Use::indirect}};
    pass.draw = [&scene, &masked, &opaque, map, settings, commands](gpu::Encoder& encoder) {
        // reversed depth: away from the light is down
        if (settings.slope_bias != 0.0f) encoder.depth_bias(0.0f, 0.0f, -settings.slope_bias);
        for (uint32_t layer = 0; layer < map.layer_count; ++layer) {
            const Planes planes = settings.culling == Culling::none ? Planes{} : caster_planes(map.layers[layer]);
            for (const DrawSet set : {draw_opaque, draw_masked}) {
                if (!scene.has(set)) continue;
                encoder.program(set == draw_opaque ? opaque : masked);
                const SceneGpu::DrawOptions options{.sets = set, .cull = &planes, .second = SceneGpu::Second::attributes, .layer = layer};
                if (commands)
                    scene.draw_indirect(encoder, options, commands, uint64_t(layer) * scene.slot_count() * sizeof(shaders::DrawCommand));
                else
                    scene.draw(encoder, options);
            }
        }
    };
    passes.raster(std::move(pass));
}

void draw_light_layers(gpu::PassList& passes, const Frame& frame, const shaders::LightMap& map, const LightMapSettings& settings,
    gpu::ImageId depth, gpu::ImageId before, OnGpu on_gpu)
{
    if (map.layers[0].warped == 2) return draw_paraboloid_layers(passes, frame, map, settings, depth);
    gpu::Device& device = passes.device();
    gpu::RasterPass pass;
    pass.name = "light map";
    if (map.fit_used != settings.fitting.fit) pass.name += fmt::format(" ({})", fit_names[size_t(map.fit_used)]);
    const std::string shaders = map.layers[0].warped != 0 ? "src/shadow/parts/light_depth_warped" : "src/shadow/parts/light_depth";
    const std::string opaque = before ? shaders + "_peel.frag" : map.layers[0].warped != 0 ? shaders + ".frag" : "";
    pass.program = &device.raster_program(shaders + ".vert", opaque);
    if (before) pass.bindings = {gpu::Binding(before, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
    pass.constants = caster_constants(map, settings.slope_bias, on_gpu.fitted);
    pass.depth = gpu::DepthTarget{depth};
    draw_casters(passes, frame, map, settings, std::move(pass),
        device.raster_program(shaders + "_masked.vert", shaders + (before ? "_masked_peel.frag" : "_masked.frag")), on_gpu.commands);
}

void describe_map(Fields& fields, int& map_size, shaders::FitParams& p, int largest)
{
    fields.integer("map_size", map_size, {16, double(largest)}, "texels", "Width and height of each depth layer.");
    fields.choice("fit", p.fit, fit_names,
        "What the map of a sun or spot covers: all that it lights, the part that the view sees, or that part with smaller texels near the "
        "eye: a sun's in several layers (cascades; sdsm, which the GPU fits to what the depth buffer holds); warped by the view's "
        "perspective (psm), or across the light by a chosen one (lispsm, tsm); or both. What does not suit light and view gives way to "
        "focused.");
    fields.integer("cascades", p.cascades, {1, LIGHT_MAP_MAX_LAYERS}, "layers", "How many, where `fit` has cascades.");
    fields.real("cascade_split", p.split, {0, 1}, "",
        "Cascades' ends: 0, each as long as the others; 1, each the same multiple of the one before; between. Always 1 where `fit` is "
        "sdsm.");
    fields.flag("stable_cascades", p.stable,
        "Cascades of a size that does not change when the view moves or turns, moved by whole texels: shadows' edges do not swim. They "
        "waste "
        "texels.");
    fields.real("cascade_blend", p.blend, {0, 1}, "", "The end of each cascade's length over which it is blended into the next.");
    fields.real("cascade_near", p.nearest, {0, 1000}, "m", "Cascades of one ratio begin no nearer to the eye: nothing is seen before.");
    fields.choice("warp", p.warp, {"lloyd", "sine"},
        "lispsm, cascades_warped: how the warp fades where the light shines along the view, after Lloyd, or by the sine of their angle.");
    fields.real("warp_near", p.warp_near, {0, 0.5}, "",
        "lispsm, cascades_warped: fraction of the depths seen, the nearest, that may have coarser texels for the sake of the rest.");
    fields.real(
        "psm_slide", p.psm_slide, {0, 1}, "", "psm: how far behind the eye the warp has its own, as a fraction of the depths seen.");
    fields.choice("point_layout", p.point_layout, {"cube", "tetrahedron", "dual_paraboloid"},
        "Layers of a point light, or of a spot wider than 120 degrees: the six of a cube; four wide ones, whose texels are 2.4 times as "
        "wide; or two paraboloids, whose texels are twice as wide, and in which each triangle is drawn as a box.");
}

shaders::FitParams unwarped(shaders::FitParams p)
{
    const Fit fit = Fit(p.fit);
    if (fit == Fit::psm || fit == Fit::lispsm || fit == Fit::tsm) p.fit = int(Fit::focused);
    if (fit == Fit::cascades_warped) p.fit = int(Fit::cascades);
    if (PointLayout(p.point_layout) == PointLayout::dual_paraboloid) p.point_layout = int(PointLayout::cube);
    return p;
}

LightMap draw_light_map(gpu::PassList& passes, const Frame& frame, const LightMapSettings& settings)
{
    LightMap out;
    out.constants = fit_light_map(frame.scene, frame.resources.bounds(), frame.view, frame.light, settings);
    const bool sun = frame.light.kind() == scene::LightKind::directional;
    if (Fit(settings.fitting.fit) == Fit::sdsm && sun) out.fitted = fit_to_samples(passes, frame, settings, out.constants);
    out.depth = passes.transient(depth_image(out.constants, settings));
    OnGpu on_gpu{out.fitted, {}};
    // the CPU knows but a bound of layers that the GPU fits
    const bool choose = settings.culling == Culling::receivers || (settings.culling == Culling::frustum && out.fitted);
    if (choose && sun && out.constants.layers[0].warped == 0)
        on_gpu.commands = cull_casters(passes, frame, out, settings.culling, settings.guard_texels + settings.offset_texels);
    draw_light_layers(passes, frame, out.constants, settings, out.depth, {}, on_gpu);
    if (frame.light_map) *frame.light_map = out;
    return out;
}

gpu::ImageId peel_light_map(
    gpu::PassList& passes, const Frame& frame, const LightMap& map, const LightMapSettings& settings, gpu::ImageId before)
{
    const gpu::ImageId depth = passes.transient(depth_image(map.constants, settings));
    draw_light_layers(passes, frame, map.constants, settings, depth, before, {map.fitted, {}});
    return depth;
}

} // namespace gnomon::shadow::parts
