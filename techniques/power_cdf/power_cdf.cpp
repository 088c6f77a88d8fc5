// SPDX-License-Identifier: Apache-2.0
// Filtering by a power function fitted to the distribution of depths (Gumbau, Szirmay-Kalos, Sbert, Chover 2011).
#include "techniques/power_cdf/power_cdf.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/parts/window.h"
#include "shadow/technique.h"

namespace gnomon::techniques::power_cdf {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering, parts::Averages::fixed_windows);
    fields.real("plane_bias", p.plane_bias, {0, 4}, "half windows",
        "A receiver is moved towards the light by the depth that its plane gains from the window's centre to its rim, times this.");
    fields.real("inset", p.inset, {0, 0.9}, "of the range", "The distribution is looked up so much nearer to the light than the receiver.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/power_cdf/power_cdf_values.frag",
                .format = VK_FORMAT_R32G32_SFLOAT,
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, params};
                }});
        const gpu::ImageId range = parts::window_min_max(passes, map.values, map.constants.params.kernel);
        map.constants.params.bias += 0.5f * params.plane_bias;
        parts::resolve_filtered(passes, frame, map, "techniques/power_cdf/power_cdf_resolve.frag", ResolveConstants{map.constants, params},
            {gpu::Binding(range, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)});
    }
};

} // namespace

} // namespace gnomon::techniques::power_cdf

extern const gnomon::shadow::TechniqueInfo technique_power_cdf;
const gnomon::shadow::TechniqueInfo technique_power_cdf = {
    .id = "power_cdf",
    .title = "Power-function shadow map",
    .family = "filtered hard shadows",
    .cite = "Gumbau, Szirmay-Kalos, Sbert, Chover 2011",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::power_cdf::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::power_cdf::Method>();
    },
};
