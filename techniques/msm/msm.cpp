// SPDX-License-Identifier: Apache-2.0
// Moment shadow maps (Peters and Klein 2015).
#include "techniques/msm/msm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::msm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering);
    fields.choice("format", p.format, {"f32", "u16"}, "Four 32-bit floats, or 16-bit fixed point in the basis that wastes no bits.");
    fields.real("moment_bias", p.moment_bias, {0, 10000}, "1e-6",
        "Share of a spread-out distribution's moments that is mixed in, in millionths: rounded moments belong to no distribution. At least "
        "60 with u16.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/msm/msm_values.frag",
                .format = params.format == 0 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R16G16B16A16_UNORM,
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, params};
                }});
        parts::resolve_filtered(passes, frame, map, "techniques/msm/msm_resolve.frag", ResolveConstants{map.constants, params});
    }
};

} // namespace

} // namespace gnomon::techniques::msm

extern const gnomon::shadow::TechniqueInfo technique_msm;
const gnomon::shadow::TechniqueInfo technique_msm = {
    .id = "msm",
    .title = "Moment shadow map",
    .family = "filtered hard shadows",
    .cite = "Peters, Klein 2015",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::msm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::msm::Method>();
    },
};
