// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/filtered_map.h"

#include "shadow/light_constants.h"
#include "shadow/parts/window.h"

namespace gnomon::shadow::parts {

namespace {

gpu::ImageId make_values(gpu::PassList& passes, const LightMap& map, const ValuesPass& pass)
{
    const gpu::ImageDesc depth = passes.desc(map.depth);
    const gpu::ImageId values = passes.transient(
        {pass.format, depth.size, depth.layers * uint32_t(pass.groups), 1, VK_SAMPLE_COUNT_1_BIT, false, "filtered values"});
    for (uint32_t layer = 0; layer < depth.layers; ++layer) {
        gpu::FullscreenPass out;
        out.name = "values";
        out.program = &passes.device().raster_program("shaders/fullscreen.vert", pass.shader);
        out.bindings = {gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
        out.bindings.insert(out.bindings.end(), pass.more.begin(), pass.more.end());
        out.constants = pass.constants({map.constants.layers[layer], int(layer)});
        for (int group = 0; group < pass.groups; ++group) {
            gpu::ColorTarget target{values, gpu::Load::discard};
            target.layer = layer * uint32_t(pass.groups) + uint32_t(group);
            out.colors.push_back(target);
        }
        out.colors.resize(size_t(pass.outputs)); // outputs without an image are dropped
        passes.fullscreen(std::move(out));
    }
    return values;
}

} // namespace

void describe_filter(Fields& fields, shaders::FilterParams& p)
{
    fields.integer("map_size", p.map_size, {16, 8192}, "texels", "Width and height of each depth layer.");
    fields.choice(
        "fit", p.fit, {"scene", "view"}, "What a directional light's map covers: the whole scene, or the part of it that the view sees.");
    fields.integer("kernel", p.kernel, {1, 127}, "texels", "Width of the filter window.");
    fields.choice("prefilter", p.prefilter, {"box", "gaussian"},
        "How windows are averaged: all texels alike, in constant time; or under a Gaussian of kernel / 6, in time linear in the width.");
    fields.real(
        "bias", p.bias, {0, 16}, "texels", "A receiver is moved towards the light by the depth that its plane gains over so many texels.");
}

LightMap draw_map_to_filter(gpu::PassList& passes, const Frame& frame, const shaders::FilterParams& params)
{
    return draw_light_map(
        passes, frame, {.size = params.map_size, .fit = Fit(params.fit), .guard_texels = 0.5f * float(params.kernel) + 1.0f});
}

FilteredMap draw_filtered_map(gpu::PassList& passes, const Frame& frame, const shaders::FilterParams& params, const ValuesPass& pass)
{
    return filter_map(passes, frame, draw_map_to_filter(passes, frame, params), params, pass);
}

FilteredMap filter_map(
    gpu::PassList& passes, const Frame& frame, const LightMap& map, const shaders::FilterParams& params, const ValuesPass& pass)
{
    FilteredMap out;
    out.map = map;
    out.values = make_values(passes, out.map, pass);
    out.means = pass.average                     ? pass.average(passes, out.values, params.kernel)
        : params.prefilter == PREFILTER_GAUSSIAN ? window_gaussian(passes, out.values, params.kernel)
                                                 : window_mean(passes, out.values, params.kernel);
    out.constants = {view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), out.map.constants,
        params, pass.groups, params.kernel % 2 == 0 ? 0.5f : 0.0f};
    return out;
}

void resolve_filtered(gpu::PassList& passes, const Frame& frame, const FilteredMap& map, const gpu::Program& program,
    gpu::Constants constants, std::vector<gpu::Binding> more)
{
    gpu::FullscreenPass pass;
    pass.name = "resolve";
    pass.program = &program;
    pass.bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
        gpu::Binding(map.means, gpu::Use::sample, gpu::Sampler::linear_clamp).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
    pass.bindings.insert(pass.bindings.end(), more.begin(), more.end());
    pass.constants = std::move(constants);
    pass.colors = {{frame.output}};
    passes.fullscreen(std::move(pass));
}

} // namespace gnomon::shadow::parts
