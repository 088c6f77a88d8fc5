// SPDX-License-Identifier: Apache-2.0
// Shadow mapping (Williams 1978) with percentage-closer filtering (Reeves, Salesin, Cook 1987).
#include "techniques/shadow_map/shadow_map.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"
#include "shadow/technique.h"

#include <cstddef>

namespace gnomon::techniques::shadow_map {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_map(fields, p.map_size, p.fitting, 8192);
    fields.choice("depth", p.depth, {"d32", "d16"}, "Depth format: 32-bit float or 16-bit fixed point.");
    fields.integer("pcf", p.pcf, {1, 15}, "taps", "Percentage-closer filter of n x n comparisons, one texel apart; 1 = none.");
    fields.flag("bilinear", p.bilinear, "Each comparison blends a 2 x 2 block by the hardware instead of taking the nearest texel.");
    fields.real("bias_constant", p.bias_constant, {0, 1}, "m", "Depth by which a receiver is moved towards the light.");
    fields.real("bias_slope", p.bias_slope, {0, 8}, "",
        "Polygon offset of the casters: times the depth slope, times twice the filter's radius in texels.");
    fields.real("normal_offset", p.normal_offset, {0, 16}, "texels",
        "Distance by which a receiver is moved along its normal, times the sine of the light's angle.");
    fields.choice("cull", p.cull, {"none", "back", "front"}, "Which faces of the casters are left out of the map.");
    fields.choice("culling", p.culling, {"none", "frustum", "receivers"},
        "Which instances are not drawn: none; those outside of a layer; or, under a sun, all that lie between it and no receiver that is "
        "seen. "
        "Pictures are the same.");
}

class ShadowMap final : public TechniqueWith<Params> {
public:
    explicit ShadowMap(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        constexpr VkCullModeFlags cull[] = {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_BIT};
        // A tap reads its own texel, and one further half when it is bilinear.
        const float radius = 0.5f * float(params.pcf - 1) + (params.bilinear ? 1.0f : 0.5f);
        const parts::LightMap map = parts::draw_light_map(passes, frame,
            {.size = params.map_size,
                .fitting = params.fitting,
                .format = parts::DepthFormat(params.depth),
                .slope_bias = params.bias_slope * 2.0f * radius,
                .cull = cull[params.cull],
                .culling = parts::Culling(params.culling),
                .offset_texels = params.normal_offset,
                .guard_texels = radius + 1.0f});
        const gpu::SpecConstant pcf[] = {{0, uint32_t(params.pcf)}};
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/shadow_map/shadow_map_resolve.frag", pcf),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample, params.bilinear ? gpu::Sampler::compare_linear : gpu::Sampler::compare_nearest)
                    .as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
            .constants = parts::with_map(ResolveConstants{view_constants(frame.view, frame.index),
                                             light_constants(frame.light, frame.resources.bounds()), map.constants, params},
                map, offsetof(ResolveConstants, map)),
            .colors = {{frame.output}}});
    }

    gpu::Device& device_;
};

} // namespace

} // namespace gnomon::techniques::shadow_map

extern const gnomon::shadow::TechniqueInfo technique_shadow_map;
const gnomon::shadow::TechniqueInfo technique_shadow_map = {
    .id = "shadow_map",
    .title = "Shadow map",
    .family = "shadow maps",
    .cite = "Williams 1978; Reeves, Salesin, Cook 1987",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::shadow_map::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::shadow_map::ShadowMap>(device);
    },
};
