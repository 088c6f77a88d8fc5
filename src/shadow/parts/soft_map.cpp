// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/soft_map.h"

#include "shadow/light_constants.h"

#include <cstddef>

namespace gnomon::shadow::parts {

void describe_soft(Fields& fields, shaders::SoftParams& p, int largest)
{
    describe_map(fields, p.map_size, p.fitting, largest);
    fields.real(
        "bias", p.bias, {0, 16}, "texels", "A receiver is moved towards the light by the depth that its plane gains over so many texels.");
}

LightMapSettings soft_map_settings(const shaders::SoftParams& params)
{
    return {.size = params.map_size, .fitting = params.fitting, .guard_texels = 0.125f * float(params.map_size) + 1.0f};
}

shaders::SoftResolve soft_constants(const Frame& frame, const shaders::LightMap& map, const shaders::SoftParams& params)
{
    return {view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), map, params};
}

SoftMap draw_soft_map(gpu::PassList& passes, const Frame& frame, const shaders::SoftParams& params)
{
    SoftMap out;
    out.map = draw_light_map(passes, frame, soft_map_settings(params));
    out.constants = soft_constants(frame, out.map.constants, params);
    return out;
}

void resolve_soft(gpu::PassList& passes, const Frame& frame, const LightMap& map, std::string_view shader,
    std::span<const gpu::SpecConstant> spec, gpu::Constants constants, std::vector<gpu::Binding> more, bool estimates)
{
    gpu::FullscreenPass pass;
    pass.name = "resolve";
    pass.program = &passes.device().raster_program("shaders/fullscreen.vert", shader, spec);
    pass.bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}};
    pass.bindings.insert(pass.bindings.end(), more.begin(), more.end());
    pass.constants = with_map(std::move(constants), map, offsetof(shaders::SoftResolve, map));
    pass.colors = {{frame.output}};
    if (estimates && frame.inspections) {
        gpu::FullscreenPass again = pass;
        std::vector<gpu::SpecConstant> inspect(spec.begin(), spec.end());
        inspect.push_back({31, 1u}); // inspect_penumbra
        again.name = "inspect penumbra";
        again.program = &passes.device().raster_program("shaders/fullscreen.vert", shader, inspect);
        again.colors = {{inspection_image(passes, frame)}};
        frame.inspections->push_back({"penumbra", "m", false, again.colors[0].image});
        passes.fullscreen(std::move(again));
    }
    passes.fullscreen(std::move(pass));
}

} // namespace gnomon::shadow::parts
