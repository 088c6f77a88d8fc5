// SPDX-License-Identifier: Apache-2.0
// Exponential variance shadow maps (Lauritzen and McCool 2008, section 6).
#include "techniques/evsm/evsm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

#include <algorithm>

namespace gnomon::techniques::evsm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering, parts::Averages::no_sums);
    fields.choice("components", p.components, {"2", "4"},
        "Moments of the positive warp only, or of the negative one as well: the smaller of both bounds holds.");
    fields.choice("format", p.format, {"f32", "f16"}, "Floating-point format of the moments; its range caps the exponents (80 and 10).");
    fields.real("exponent", p.exponent, {1, 80}, "", "Exponent of the positive warp over the light's depth range.");
    fields.real("negative_exponent", p.negative_exponent, {1, 80}, "", "Exponent of the negative warp over the light's depth range.");
    fields.real("min_deviation", p.min_deviation, {0, 0.1}, "depth range",
        "Standard deviation that a window is given at least, as a fraction of the light's depth range.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        Params capped = params;
        // exp(2 c t / 2) with t in [-1, 1] has to stay below the format's largest number: e^88 and e^11.
        const float largest = params.format == 0 ? 80.0f : 10.0f;
        capped.exponent = std::min(params.exponent, largest);
        capped.negative_exponent = std::min(params.negative_exponent, largest);
        constexpr VkFormat formats[2][2]
            = {{VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R16G16_SFLOAT}, {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT}};
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/evsm/evsm_values.frag",
                .format = formats[params.components][params.format],
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, capped};
                }});
        parts::resolve_filtered(passes, frame, map, "techniques/evsm/evsm_resolve.frag", ResolveConstants{map.constants, capped});
    }
};

} // namespace

} // namespace gnomon::techniques::evsm

extern const gnomon::shadow::TechniqueInfo technique_evsm;
const gnomon::shadow::TechniqueInfo technique_evsm = {
    .id = "evsm",
    .title = "Exponential variance shadow map",
    .family = "filtered hard shadows",
    .cite = "Lauritzen, McCool 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::evsm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::evsm::Method>();
    },
};
