// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_culling.h"

#include "shadow/light_constants.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/fullscreen_layers.h"
#include "shadow/parts/n_buffer.h"
#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/light_depth.shared.h"
#include "src/shadow/parts/volume_mask.shared.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace gnomon::shadow::parts {

namespace {

/// Texels a side of the picture of triangles from the light: at most one in each texel is tried as what darkens a receiver.
constexpr int triangle_texels = 1024;

/// The axis of the picture, 0 or 1, along which volumes run: where in clip space they run to, which is the light's direction, or from.
uint32_t band_axis(const scene::View& view, const scene::Light& light)
{
    vec4 p(0, 0, 0, 1);
    if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) p = vec4(sun->direction, 0);
    if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) p = vec4(spot->position, 1);
    if (const auto* point = std::get_if<scene::PointLight>(&light.shape)) p = vec4(point->position, 1);
    const vec4 clip = view.clip_from_world * p;
    return std::abs(clip.x) * float(view.size.width) >= std::abs(clip.y) * float(view.size.height) ? 0 : 1;
}

gpu::BufferId make_buffer(gpu::PassList& passes, uint64_t words, const char* name)
{
    const gpu::BufferId buffer = passes.transient(gpu::BufferDesc{words * sizeof(uint32_t), 0, gpu::Memory::device, name});
    passes.fill(buffer, 0, "clear");
    return buffer;
}

/// The slot and triangle that each texel of the light sees first. Opaque ones alone: they darken wherever they are.
gpu::ImageId draw_triangles(gpu::PassList& passes, const Frame& frame, const shaders::LightMap& map)
{
    SceneGpu& scene = frame.resources;
    const gpu::Size size{triangle_texels, triangle_texels};
    const gpu::ImageId ids = passes.transient(
        gpu::ImageDesc{VK_FORMAT_R32G32_UINT, size, map.layer_count, 1, VK_SAMPLE_COUNT_1_BIT, false, "light triangles"});
    gpu::RasterPass pass;
    pass.name = "light triangles";
    pass.program = &passes.device().raster_program("src/shadow/parts/volume_triangles.vert", "src/shadow/parts/volume_triangles.frag");
    pass.bindings = {{passes.import(scene.instances()), gpu::Use::load}};
    pass.constants = caster_constants(map, 0.0f, {});
    pass.colors = {{ids, gpu::Load::clear, {.uint32 = {~0u}}}};
    pass.depth = gpu::DepthTarget{passes.transient(
        gpu::ImageDesc{VK_FORMAT_D32_SFLOAT, size, map.layer_count, 1, VK_SAMPLE_COUNT_1_BIT, false, "light triangles' depth"})};
    pass.layers = map.layer_count;
    pass.depth_clamp = map.layers[0].perspective == 0;
    pass.streams = {SceneGpu::position_stream()};
    pass.draw = [&scene, map](gpu::Encoder& encoder) {
        for (uint32_t layer = 0; layer < map.layer_count; ++layer) {
            const Planes planes = caster_planes(map.layers[layer]);
            scene.draw(encoder, {.sets = draw_opaque, .cull = &planes, .layer = layer});
        }
    };
    passes.raster(std::move(pass));
    return ids;
}

gpu::BufferId mark_receivers(
    gpu::PassList& passes, const Frame& frame, const shaders::VolumeMaskConstants& constants, const VolumeCulling& culling)
{
    SceneGpu& scene = frame.resources;
    constexpr uint64_t words = sizeof(shaders::VolumeTexel) / sizeof(uint32_t);
    const uint64_t texels = uint64_t(VOLUME_MASK_SIZE) * VOLUME_MASK_SIZE * constants.map.layer_count;
    const gpu::BufferId mask = make_buffer(passes, 1 + texels * words, "receiver mask");
    const gpu::ImageId triangles = culling.casters ? draw_triangles(passes, frame, constants.map) : frame.gbuffer.normal;
    const gpu::SpecConstant modes[] = {{0, uint32_t(culling.casters)}, {1, culling.decided ? 1u : 0u}};
    gpu::RasterPass pass{.name = "receiver mask",
        .program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_mask.frag", modes),
        .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {mask, gpu::Use::update},
            gpu::Binding(triangles, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {passes.import(scene.instances()), gpu::Use::load},
            {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.positions()), gpu::Use::load},
            {culling.decided ? culling.decided : frame.gbuffer.depth, gpu::Use::sample}},
        .constants = constants,
        .size = frame.view.size};
    pass.draw = [](gpu::Encoder& encoder) { encoder.draw(3); };
    passes.raster(std::move(pass));
    return mask;
}

/// The greatest reach within any rectangle of the mask.
NBuffer build_windows(gpu::PassList& passes, gpu::BufferId mask, uint32_t layers)
{
    const gpu::ImageId reach = passes.transient(gpu::ImageDesc{
        VK_FORMAT_R32_SFLOAT, {VOLUME_MASK_SIZE, VOLUME_MASK_SIZE}, layers, 1, VK_SAMPLE_COUNT_1_BIT, false, "receivers' reach"});
    fullscreen_layers(passes,
        {"receivers' reach", &passes.device().raster_program("shaders/fullscreen_layers.vert", "src/shadow/parts/volume_reach.frag"),
            {{mask, gpu::Use::load}}, {}, {{reach, gpu::Load::discard}}},
        layers);
    return build_min_max_n_buffer(passes, reach);
}

} // namespace

shaders::VolumeBands volume_bands(const scene::View& view, const scene::Light& light, int count)
{
    const uint32_t axis = band_axis(view, light);
    const int size = axis == 0 ? view.size.width : view.size.height;
    shaders::VolumeBands bands{};
    bands.count = uint32_t(std::clamp(count, 1, std::min(size, VOLUME_MAX_BANDS)));
    const mat4 rows = glm::transpose(view.clip_from_world);
    for (uint32_t b = 0; b <= bands.count; ++b) {
        const uint32_t pixel = (b * uint32_t(size) + bands.count - 1) / bands.count; // the first of band b
        bands.planes[b] = rows[int(axis)] - (2.0f * float(pixel) / float(size) - 1.0f) * rows[3];
    }
    return bands;
}

CulledVolumes cull_volumes(gpu::PassList& passes, const Frame& frame, const VolumeCulling& culling)
{
    SceneGpu& scene = frame.resources;
    const LightMapSettings settings{.size = triangle_texels, .fitting = {.fit = int(Fit::focused)}};
    const CulledVolumes out{make_buffer(passes, std::max(scene.slot_count(), 1u), "volumes' bands"),
        volume_bands(frame.view, frame.light, culling.clamp ? culling.bands : 1)};
    shaders::VolumeMaskConstants constants{view_constants(frame.view, frame.index), light_constants(frame.light, scene.bounds()),
        fit_light_map(frame.scene, scene.bounds(), frame.view, frame.light, settings), {}, band_axis(frame.view, frame.light),
        out.bands.count, scene.slot_count()};
    const gpu::BufferId mask = mark_receivers(passes, frame, constants, culling);
    gpu::ImageId windows = frame.gbuffer.depth; // where they are not asked
    if (culling.max) {
        const NBuffer built = build_windows(passes, mask, constants.map.layer_count);
        constants.windows = built.constants;
        windows = built.image;
    }
    const gpu::SpecConstant ways[] = {{0, uint32_t(culling.max)}, {1, uint32_t(culling.clamp || !culling.max)}};
    const uint32_t row = std::clamp(constants.slots, 1u, 1u << 15); // half of the groups that every device runs along an axis
    passes.compute({.name = "cull volumes",
        .program = &passes.device().compute_program("src/shadow/parts/volume_casters.comp", ways),
        .bindings = {{passes.import(scene.casters()), gpu::Use::load}, {mask, gpu::Use::load}, {out.slots, gpu::Use::update},
            gpu::Binding(windows, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
        .constants = constants,
        .threads = {row * VOLUME_CULL_GROUP, (constants.slots + row - 1) / row, 1}});
    if (!frame.counters) return out;
    const gpu::BufferId counts = make_buffer(passes, 2, "culled volumes");
    passes.compute({.name = "count culled",
        .program = &passes.device().compute_program("src/shadow/parts/volume_count.comp"),
        .bindings = {{passes.import(scene.casters()), gpu::Use::load}, {out.slots, gpu::Use::load}, {counts, gpu::Use::update}},
        .constants = constants,
        .threads = {constants.slots, 1, 1}});
    frame.counters->push_back({"casters_culled", counts, 0});
    frame.counters->push_back({"bands_culled", counts, sizeof(uint32_t)});
    return out;
}

} // namespace gnomon::shadow::parts
