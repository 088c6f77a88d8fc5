// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/filtered_map.h"

#include "shadow/light_constants.h"
#include "shadow/parts/pyramid.h"
#include "shadow/parts/summed_area_table.h"
#include "shadow/parts/window.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::shadow::parts {

int channels_of(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R32_SFLOAT:
        return 1;
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R16G16_UNORM:
        return 2;
    default:
        return 4;
    }
}

gpu::ImageId draw_values(gpu::PassList& passes, const LightMap& map, int prefilter, const ValuesPass& pass)
{
    const gpu::ImageDesc depth = passes.desc(map.depth);
    const uint32_t mips = pass.with_mips ? pyramid_levels(depth.size) : 1;
    const gpu::ImageId values = passes.transient(
        {pass.format, depth.size, depth.layers * uint32_t(pass.groups), mips, VK_SAMPLE_COUNT_1_BIT, false, "filtered values"});
    for (uint32_t layer = 0; layer < depth.layers; ++layer) {
        gpu::FullscreenPass out;
        out.name = "values";
        out.program = &passes.device().raster_program("shaders/fullscreen.vert", pass.shader);
        out.bindings = {gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
        out.bindings.insert(out.bindings.end(), pass.more.begin(), pass.more.end());
        out.constants = with_layer(
            pass.constants({map.constants.layers[layer], int(layer), prefilter}), map, layer, offsetof(shaders::FilterValues, layer));
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

void describe_filter(Fields& fields, shaders::FilterParams& p, Averages averages)
{
    describe_map(fields, p.map_size, p.fitting, 4096);
    fields.integer("kernel", p.kernel, {1, 127}, "texels", "Width of the filter window; at most a quarter of the map.");
    std::vector<std::string> ways = {"box", "gaussian", "mips", "sums"};
    ways.resize(averages == Averages::all ? 4 : averages == Averages::no_sums ? 3 : 2);
    std::string help
        = "How windows are averaged: `box`, all texels alike in constant time; `gaussian` of kernel / 6, in time linear in the width";
    if (averages != Averages::fixed_windows) help += "; `mips`, boxes, and mips of them where a pixel covers more";
    if (averages == Averages::all) help += "; `sums`, a summed-area table, windows as wide as the kernel or the pixel";
    fields.choice("prefilter", p.prefilter, ways, (help + ".").c_str());
    fields.real("bias", p.bias, {0, 1}, "windows",
        "A receiver is moved towards the light by the depth that its plane gains over so much of the window's width.");
}

LightMap draw_map_to_filter(gpu::PassList& passes, const Frame& frame, const shaders::FilterParams& params)
{
    return draw_light_map(passes, frame,
        {.size = params.map_size,
            .fitting = params.fitting,
            .guard_texels = 0.5f * float(filter_width(params.kernel, params.map_size)) + 1.0f});
}

FilteredMap draw_filtered_map(gpu::PassList& passes, const Frame& frame, const shaders::FilterParams& params, const ValuesPass& pass)
{
    return filter_map(passes, frame, draw_map_to_filter(passes, frame, params), params, pass);
}

FilteredMap filter_map(
    gpu::PassList& passes, const Frame& frame, const LightMap& map, const shaders::FilterParams& params, const ValuesPass& pass)
{
    const int width = filter_width(params.kernel, params.map_size);
    FilteredMap out;
    out.map = map;
    out.values = draw_values(passes, map, params.prefilter, pass);
    out.constants = {view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), out.map.constants,
        params, pass.groups, width % 2 == 0 ? 0.5f : 0.0f};
    out.constants.params.kernel = width;
    out.means = out.values;
    out.sums = passes.transient({VK_FORMAT_R32_UINT, {1, 1}, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "no sums"});
    if (params.prefilter == PREFILTER_SUMS) {
        // windows grow with a pixel's footprint up to this width, to which the integers' precision is fitted
        out.constants.widest = std::min(std::max(2.0f * float(width), 64.0f), float(params.map_size));
        const int bits = std::min(integer_sum_bits(std::pow(out.constants.widest, 2.0)), 24);
        out.constants.sum_step = integer_sum_step(bits);
        out.sums = build_integer_sums(passes, out.values, channels_of(pass.format), bits);
    } else {
        passes.clear(out.sums, {});
        const auto average = pass.average ? pass.average : params.prefilter == PREFILTER_GAUSSIAN ? window_gaussian : window_mean;
        out.means = average(passes, out.values, width, params.prefilter == PREFILTER_MIPS);
    }
    if (params.prefilter == PREFILTER_MIPS) fill_mean_pyramid(passes, out.means);
    return out;
}

void resolve_filtered(gpu::PassList& passes, const Frame& frame, const FilteredMap& map, std::string_view shader, gpu::Constants constants,
    std::vector<gpu::Binding> more)
{
    gpu::FullscreenPass pass;
    pass.name = "resolve";
    const gpu::SpecConstant spec[] = {{0, uint32_t(map.constants.params.prefilter)}};
    pass.program = &passes.device().raster_program("shaders/fullscreen.vert", shader, spec);
    pass.bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
        gpu::Binding(map.means, gpu::Use::sample, gpu::Sampler::linear_clamp).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
        gpu::Binding(map.sums, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)};
    pass.bindings.insert(pass.bindings.end(), more.begin(), more.end());
    pass.constants = with_map(std::move(constants), map.map, offsetof(shaders::FilterResolve, map));
    pass.colors = {{frame.output}};
    passes.fullscreen(std::move(pass));
}

} // namespace gnomon::shadow::parts
