// SPDX-License-Identifier: Apache-2.0
// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel, Kautz 2007).
#include "techniques/csm/csm.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/technique.h"

namespace gnomon::techniques::csm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_filter(fields, p.filtering);
    fields.integer("terms", p.terms, {2, 16}, "",
        "Terms of the Fourier series; each stores a sine and a cosine. Odd numbers count as the next even one.");
    fields.choice("format", p.format, {"u8", "u16"}, "Bits of each stored sine and cosine.");
    fields.real("attenuation", p.attenuation, {0, 8}, "", "Damping of the high terms against ringing: exp(-attenuation (k / terms)^2).");
    fields.real("offset", p.offset, {0, 0.2}, "depth range", "Receivers are compared so much nearer to the light.");
    fields.real("scale", p.scale, {1, 8}, "", "Factor on the result before it is cut off at 1: a surface on its own depth has 1/2.");
    fields.real("bleed_reduction", p.bleed_reduction, {0, 0.9}, "",
        "Fractions of light up to this one become dark, above all the series' ripples in umbrae; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const int groups = (params.terms + 1) / 2;
        const parts::FilteredMap map = parts::draw_filtered_map(passes, frame, params.filtering,
            {.shader = "techniques/csm/csm_values.frag",
                .format = params.format == 0 ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R16G16B16A16_UNORM,
                .groups = groups,
                .outputs = 8,
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, params};
                }});
        parts::resolve_filtered(passes, frame, map, "techniques/csm/csm_resolve.frag", ResolveConstants{map.constants, params});
    }
};

} // namespace

} // namespace gnomon::techniques::csm

extern const gnomon::shadow::TechniqueInfo technique_csm;
const gnomon::shadow::TechniqueInfo technique_csm = {
    .id = "csm",
    .title = "Convolution shadow map",
    .family = "filtered hard shadows",
    .cite = "Annen, Mertens, Bekaert, Seidel, Kautz 2007",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::csm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::csm::Method>();
    },
};
