// SPDX-License-Identifier: Apache-2.0
// Variance shadow maps (Donnelly and Lauritzen 2006; Lauritzen 2007).
#include "techniques/vsm/vsm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::vsm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering);
    fields.real("min_deviation", p.min_deviation, {0, 0.1}, "depth range",
        "Standard deviation that a window is given at least, as a fraction of the light's depth range: rounding must not look like an "
        "edge.");
    fields.flag("slope_moment", p.slope_moment, "Count the depth that a tilted surface covers within a texel into the second moment.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/vsm/vsm_values.frag", .format = VK_FORMAT_R32G32_SFLOAT, .constants = [&](const FilterValues& layer) {
                 return ValuesConstants{layer, params};
             }});
        parts::resolve_filtered(passes, frame, map, "techniques/vsm/vsm_resolve.frag", ResolveConstants{map.constants, params});
    }
};

} // namespace

} // namespace gnomon::techniques::vsm

extern const gnomon::shadow::TechniqueInfo technique_vsm;
const gnomon::shadow::TechniqueInfo technique_vsm = {
    .id = "vsm",
    .title = "Variance shadow map",
    .family = "filtered hard shadows",
    .cite = "Donnelly, Lauritzen 2006; Lauritzen 2007",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::vsm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::vsm::Method>();
    },
};
