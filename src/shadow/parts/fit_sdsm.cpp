// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/sdsm.h"

#include "shadow/light_constants.h"
#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"

#include <algorithm>

namespace gnomon::shadow::parts {

namespace {

Bounds along(const mat4& axes, const std::vector<vec3>& points)
{
    Bounds out;
    for (const vec3 p : points) out.add(vec3(axes * vec4(p, 1)));
    return out;
}

/// Holds every layer that may be fitted: a square about part of the visible points is no wider than one about all, and its centre is among
/// them.
shaders::LightMapLayer widest_layer(
    const mat4& axes, const Bounds& seen, const Bounds& casters, float least_extent, const LightMapSettings& settings)
{
    const float extent = std::max({seen.max.x - seen.min.x, seen.max.y - seen.min.y, least_extent}) * rim_factor(settings);
    return orthographic_layer(
        axes, vec2(seen.centre()), 2.0f * extent, {seen.min.z, seen.max.z}, {casters.min.z, casters.max.z}, settings.size);
}

} // namespace

gpu::BufferId fit_to_samples(gpu::PassList& passes, const Frame& frame, const LightMapSettings& settings, shaders::LightMap& map)
{
    map.fit_used = settings.fitting.fit;
    const Bounds& bounds = frame.resources.bounds();
    const auto& sun = std::get<scene::DirectionalLight>(frame.light.shape);
    const mat4 axes = light_axes(bounds.centre(), sun.direction, vec3(0, 1, 0));
    const std::vector<vec3> box = corners(bounds), visible = visible_part(frame.view, bounds);
    const Bounds casters = along(axes, box), seen = visible.empty() ? casters : along(axes, visible);
    // positions round to some ten-millionths of the scene: texels are no finer
    const float least_extent = std::max(1e-6f * bounds.radius(), 1e-7f) * float(settings.size);
    for (uint32_t i = 0; i < map.layer_count; ++i) map.layers[i] = widest_layer(axes, seen, casters, least_extent, settings);

    const shaders::SdsmFit fit{map, axes, settings.fitting, {casters.min.z, casters.max.z}, rim_factor(settings), least_extent,
        frame.view.orthographic ? 0.0f : frame.view.near};
    const shaders::SdsmReduce reduce{view_constants(frame.view, frame.index), axes};
    const gpu::BufferId fitted = passes.transient({sizeof(shaders::FittedMap), 0, gpu::Memory::device, "fitted light map"});
    passes.fill(fitted, ~0u, "fit clear");

    const auto add_reduction = [&](bool of_cascades, uint32_t groups) {
        const gpu::SpecConstant spec[] = {{0, uint32_t(of_cascades)}};
        const auto tiles = [](int pixels) { return 16 * ((uint32_t(pixels) + 63) / 64); };
        passes.compute({.name = "fit reduce",
            .program = &passes.device().compute_program("src/shadow/parts/sdsm_reduce.comp", spec),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {fitted, gpu::Use::update}},
            .constants = reduce,
            .threads = {tiles(frame.view.size.width), tiles(frame.view.size.height), groups}});
    };
    const auto add_step = [&](const char* name, const char* shader) {
        passes.compute({.name = name,
            .program = &passes.device().compute_program(shader),
            .bindings = {{fitted, gpu::Use::update}},
            .constants = fit,
            .threads = {1, 1, 1}});
    };
    add_reduction(false, 1);
    add_step("fit splits", "src/shadow/parts/sdsm_splits.comp");
    add_reduction(true, map.layer_count);
    add_step("fit layers", "src/shadow/parts/sdsm_layers.comp");
    return fitted;
}

} // namespace gnomon::shadow::parts
