// SPDX-License-Identifier: Apache-2.0
// Shadow mapping (Williams 1978) with percentage-closer filtering (Reeves, Salesin, Cook 1987).
#include "techniques/shadow_map/shadow_map.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/bias.h"
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
    parts::describe_bias(fields, p.bias, true);
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
        // A tap reads its own texel, and one further half when it is bilinear.
        const float reach = 0.5f * float(params.pcf - 1) + (params.bilinear ? 1.0f : 0.5f);
        const parts::LightMapSettings settings{.size = params.map_size,
            .fitting = params.fitting,
            .format = parts::DepthFormat(params.depth),
            .culling = parts::Culling(params.culling),
            .guard_texels = reach + 1.0f};
        const parts::LightMap map = parts::draw_biased_map(passes, frame, settings, params.bias, reach);
        const bool by_id = params.bias.kind == BIAS_IDS;
        if (by_id && !starts_) starts_ = parts::instance_starts(device_, frame.scene);
        const gpu::ImageId ids = by_id ? parts::draw_light_ids(passes, frame, map, settings) : frame.gbuffer.primitive;
        const gpu::SpecConstant modes[] = {{0, uint32_t(params.pcf)}, {1, uint32_t(params.bias.kind)}, {2, uint32_t(params.bilinear)}};
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/shadow_map/shadow_map_resolve.frag", modes),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {frame.gbuffer.primitive, gpu::Use::sample},
                gpu::Binding(ids, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                {passes.import(by_id ? starts_ : frame.resources.instances()), gpu::Use::load}},
            .constants = parts::with_map(ResolveConstants{view_constants(frame.view, frame.index),
                                             light_constants(frame.light, frame.resources.bounds()), map.constants, params, reach},
                map, offsetof(ResolveConstants, map)),
            .colors = {{frame.output}}});
    }

    gpu::Device& device_;
    gpu::Buffer starts_; ///< made when first asked for
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
    .reads_ids =
        [](std::span<const std::byte> bytes) {
            gnomon::techniques::shadow_map::Params params;
            memcpy(&params, bytes.data(), sizeof(params));
            return params.bias.kind == BIAS_IDS;
        },
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::shadow_map::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::shadow_map::ShadowMap>(device);
    },
};
