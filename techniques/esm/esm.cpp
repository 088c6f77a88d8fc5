// SPDX-License-Identifier: Apache-2.0
// Exponential shadow maps (Annen, Mertens, Seidel, Flerackers, Kautz 2008; Salvi 2008).
#include "techniques/esm/esm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/parts/window.h"
#include "shadow/technique.h"

#include <algorithm>

namespace gnomon::techniques::esm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering, parts::Averages::no_sums);
    fields.real("exponent", p.exponent, {1, 5000}, "", "Exponent over the light's depth range; in `linear` space at most 160.");
    fields.choice("space", p.space, {"linear", "log"},
        "Average the exponentials as they are, or their logarithms by log-sum-exp, which has no largest exponent.");
    fields.choice("fallback", p.fallback, {"none", "overflow", "max_depth"},
        "Where to filter by comparisons instead: nowhere, where the mean exceeds what a flat window could give, or where any texel lies "
        "behind.");
    fields.real("threshold", p.threshold, {0, 10}, "", "How far above 1 the mean may lie before `overflow` falls back.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        Params capped = params;
        // exp(c t / 2) with t in [-1, 1] and sums of 127 of them stay below 3e38 up to exp(83).
        if (params.space == 0) capped.exponent = std::min(params.exponent, 160.0f);
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/esm/esm_values.frag",
                .format = params.fallback == 2 ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32_SFLOAT, // window_min_max takes pairs
                .constants =
                    [&](const FilterValues& layer) {
                        return ValuesConstants{layer, capped};
                    },
                .average = params.space == 1 ? parts::window_log_mean_exp : nullptr});
        const bool by_depth = params.fallback == 2;
        const gpu::ImageId largest = by_depth ? parts::window_min_max(passes, map.values, map.constants.params.kernel) : map.values;
        parts::resolve_filtered(passes, frame, map, "techniques/esm/esm_resolve.frag", ResolveConstants{map.constants, capped},
            {gpu::Binding(map.values, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                gpu::Binding(largest, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)});
    }
};

} // namespace

} // namespace gnomon::techniques::esm

extern const gnomon::shadow::TechniqueInfo technique_esm;
const gnomon::shadow::TechniqueInfo technique_esm = {
    .id = "esm",
    .title = "Exponential shadow map",
    .family = "filtered hard shadows",
    .cite = "Annen, Mertens, Seidel, Flerackers, Kautz 2008; Salvi 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::esm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::esm::Method>();
    },
};
