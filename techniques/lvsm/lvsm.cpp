// SPDX-License-Identifier: Apache-2.0
// Layered variance shadow maps (Lauritzen and McCool 2008).
#include "techniques/lvsm/lvsm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::lvsm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering);
    fields.integer("layers", p.layers, {1, 8}, "", "Stretches of depth with moments of their own.");
    fields.choice("split", p.split, {"uniform", "lloyd"},
        "Where the layers lie: evenly over the depth range, or around the clusters of the depths in the map.");
    fields.choice("format", p.format, {"f32", "u16"}, "32-bit floating point or 16-bit fixed point moments.");
    fields.real("overlap", p.overlap, {0, 0.5}, "layers", "How far each layer reaches into the one behind, as a fraction of it.");
    fields.real("min_deviation", p.min_deviation, {0, 0.1}, "depth range",
        "Standard deviation that a window is given at least, as a fraction of the light's depth range.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

/// The depths where layers meet, layers + 1 of them.
gpu::BufferId place_layers(gpu::PassList& passes, const parts::LightMap& map, const Params& params)
{
    const gpu::BufferId counts = passes.transient({LVSM_BINS * sizeof(uint32_t), 0, gpu::Memory::device, "depth histogram"});
    const gpu::BufferId bounds = passes.transient({(LVSM_MAX_LAYERS + 1) * sizeof(float), 0, gpu::Memory::device, "layer bounds"});
    passes.fill(counts, 0);
    const uint32_t groups = (uint32_t(params.filtering.map_size) + 63) / 64;
    for (uint32_t layer = 0; params.split == 1 && layer < map.constants.layer_count; ++layer) {
        gpu::ComputePass count;
        count.name = "histogram";
        count.program = &passes.device().compute_program("techniques/lvsm/lvsm_histogram.comp");
        count.bindings = {gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {counts, gpu::Use::update}};
        count.constants = parts::with_layer(HistogramConstants{{map.constants.layers[layer], int(layer)}}, map, layer, 0);
        count.threads = {16 * groups, 16 * groups, 1};
        passes.compute(std::move(count));
    }
    gpu::ComputePass place;
    place.name = "place layers";
    place.program = &passes.device().compute_program("techniques/lvsm/lvsm_place.comp");
    place.bindings = {{counts, gpu::Use::load}, {bounds, gpu::Use::store}};
    place.constants = PlaceConstants{params};
    passes.compute(std::move(place));
    return bounds;
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::LightMap light_map = parts::draw_map_to_filter(passes, frame, params.filtering);
        const gpu::BufferId bounds = place_layers(passes, light_map, params);
        const parts::FilteredMap map = parts::filter_map(passes, frame, light_map, params.filtering,
            {.shader = "techniques/lvsm/lvsm_values.frag",
                .format = params.format == 0 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_UNORM,
                .groups = (params.layers + 1) / 2,
                .outputs = LVSM_MAX_LAYERS / 2,
                .more = {{bounds, gpu::Use::load}},
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, params};
                }});
        parts::resolve_filtered(
            passes, frame, map, "techniques/lvsm/lvsm_resolve.frag", ResolveConstants{map.constants, params}, {{bounds, gpu::Use::load}});
    }
};

} // namespace

} // namespace gnomon::techniques::lvsm

extern const gnomon::shadow::TechniqueInfo technique_lvsm;
const gnomon::shadow::TechniqueInfo technique_lvsm = {
    .id = "lvsm",
    .title = "Layered variance shadow map",
    .family = "filtered hard shadows",
    .cite = "Lauritzen, McCool 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::lvsm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::lvsm::Method>();
    },
};
