// SPDX-License-Identifier: Apache-2.0
// Variance soft shadow mapping (Dong and Yang 2010).
#include "techniques/vssm/vssm.shared.h"

#include "shadow/parts/prefiltered_soft.h"
#include "shadow/technique.h"

namespace gnomon::techniques::vssm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_prefiltered_soft(fields, p.prefiltered);
    fields.choice("subdivision", p.subdivision, {"none", "uniform", "adaptive", "mixed"},
        "How kernels are divided of which the moments alone say nothing: not at all (they count as lit); into a grid; by a quad-tree; or a "
        "grid for the blockers' depth and a tree for the shadow.");
    fields.integer("grid", p.grid, {2, 8}, "", "Parts a side of uniform subdivision.");
    fields.integer("height", p.height, {1, 4}, "", "Levels of the quad-tree below the kernel itself.");
    fields.choice("bound", p.per_cell, {"pooled", "per_cell"},
        "Chebyshev's bound of all of a kernel's undivided parts at once, or of each by itself, dividing also where depths vary: tighter.");
    fields.flag("centred", p.centred, "In the grid of the search, blockers near the window's middle count more for the mean depth.");
    fields.real("flat_deviation", p.flat_deviation, {0, 0.1}, "depth range",
        "A part of a kernel whose depths have a smaller standard deviation than this is one surface.");
    fields.real("min_deviation", p.min_deviation, {0, 0.1}, "depth range", "Standard deviation that a window is given at least.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::PrefilteredSoftMap map = parts::draw_prefiltered_soft(passes, frame, params.prefiltered);
        const bool integer = params.prefiltered.sums == SUMS_INTEGER;
        const gpu::ImageId sums = parts::sum_values(
            passes, map, params.prefiltered, {.shader = "techniques/vssm/vssm_values.frag", .constants = [&](const FilterValues& layer) {
                                                  return ValuesConstants{layer, map.constants.sum_step};
                                              }});

        const uint32_t search = uint32_t(params.subdivision == SUBDIVIDE_MIXED ? SUBDIVIDE_UNIFORM : params.subdivision);
        const uint32_t filter = uint32_t(params.subdivision == SUBDIVIDE_MIXED ? SUBDIVIDE_ADAPTIVE : params.subdivision);
        const gpu::SpecConstant modes[] = {{0, search}, {1, filter}, {2, uint32_t(params.per_cell)}, {3, uint32_t(params.grid)}};
        parts::resolve_prefiltered_soft(passes, frame, map,
            integer ? "techniques/vssm/vssm_integer.frag" : "techniques/vssm/vssm_float.frag", modes,
            ResolveConstants{map.soft.constants, map.constants, params},
            {gpu::Binding(sums, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)});
    }
};

} // namespace

} // namespace gnomon::techniques::vssm

extern const gnomon::shadow::TechniqueInfo technique_vssm;
const gnomon::shadow::TechniqueInfo technique_vssm = {
    .id = "vssm",
    .title = "Variance soft shadow mapping",
    .family = "soft shadows",
    .cite = "Dong, Yang 2010",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::vssm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::vssm::Method>();
    },
};
