// SPDX-License-Identifier: Apache-2.0
// Moment soft shadow mapping (Peters, Muenstermann, Wetzstein and Klein 2017).
#include "techniques/moment_soft/moment_soft.shared.h"

#include "shadow/parts/prefiltered_soft.h"
#include "shadow/technique.h"

namespace gnomon::techniques::moment_soft {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_prefiltered_soft(fields, p.prefiltered);
    fields.integer("grid", p.grid, {1, 8}, "", "Parts a side into which windows are divided; 1 divides nothing.");
    fields.flag("centred", p.centred, "In a divided search, blockers near the window's middle count more for the mean depth.");
    fields.real("tilt", p.tilt, {0, 1}, "parts",
        "A receiver is moved towards the light by the depth that its plane gains over so much of a part's width: 1/2 clears the plane.");
    fields.real("depth_bias", p.depth_bias, {0, 0.1}, "depth range",
        "A receiver is moved towards the light by so much more: its own depth and rounding are blockers otherwise.");
    fields.real("moment_bias", p.moment_bias, {0, 10000}, "1e-6",
        "Share of a spread-out distribution's moments that is mixed in, in millionths: rounded moments belong to no distribution.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::PrefilteredSoftMap map = parts::draw_prefiltered_soft(passes, frame, params.prefiltered);
        const bool integer = params.prefiltered.sums == SUMS_INTEGER;
        const gpu::ImageId sums = parts::sum_values(passes, map, params.prefiltered,
            {.shader = "techniques/moment_soft/moment_soft_values.frag",
                .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                .constants = [&](const FilterValues& layer) {
                    return ValuesConstants{layer, map.constants.sum_step};
                }});
        const gpu::SpecConstant parts_a_side[] = {{0, uint32_t(params.grid)}};
        parts::resolve_prefiltered_soft(passes, frame, map,
            integer ? "techniques/moment_soft/moment_soft_integer.frag" : "techniques/moment_soft/moment_soft_float.frag", parts_a_side,
            ResolveConstants{map.soft.constants, map.constants, params},
            {gpu::Binding(sums, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)});
    }
};

} // namespace

} // namespace gnomon::techniques::moment_soft

extern const gnomon::shadow::TechniqueInfo technique_moment_soft;
const gnomon::shadow::TechniqueInfo technique_moment_soft = {
    .id = "moment_soft",
    .title = "Moment soft shadow mapping",
    .family = "soft shadows",
    .cite = "Peters et al. 2017",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::moment_soft::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::moment_soft::Method>();
    },
};
