// SPDX-License-Identifier: Apache-2.0
// Variance soft shadow mapping (Dong and Yang 2010).
#include "techniques/vssm/vssm.shared.h"

#include "shadow/parts/pyramid.h"
#include "shadow/parts/soft_map.h"
#include "shadow/parts/summed_area_table.h"
#include "shadow/technique.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::techniques::vssm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_soft(fields, p.soft);
    fields.choice("sums", p.sums, {"integer", "float"},
        "Summed-area table of 32-bit integers, exact for windows of up to `widest`, or of 32-bit floats.");
    fields.real("widest", p.widest, {0.02, 0.5}, "of the map",
        "Side of the widest window; larger ones are cut down to it. Integers have 32 bits less those that count a window's texels.");
    fields.choice("subdivision", p.subdivision, {"none", "uniform", "adaptive", "mixed"},
        "How kernels are divided of which the moments alone say nothing: not at all (they count as lit); into a grid; by a quad-tree; or a "
        "grid for the blockers' depth and a tree for the shadow.");
    fields.integer("grid", p.grid, {2, 16}, "", "Parts a side of uniform subdivision.");
    fields.integer("height", p.height, {1, 4}, "", "Levels of the quad-tree below the kernel itself.");
    fields.choice("bound", p.per_cell, {"pooled", "per_cell"},
        "Chebyshev's bound of all of a kernel's undivided parts at once, or of each by itself, dividing also where depths vary: tighter.");
    fields.choice("kernel", p.equal_area, {"circumscribed", "equal_area"},
        "The square that stands for a round light: around its disk, or of the disk's area.");
    fields.real("flat_deviation", p.flat_deviation, {0, 0.1}, "depth range",
        "A part of a kernel whose depths have a smaller standard deviation than this is one surface.");
    fields.real("min_deviation", p.min_deviation, {0, 0.1}, "depth range", "Standard deviation that a window is given at least.");
    fields.real("contact", p.contact, {0, 0.2}, "scene radius",
        "Where blockers are nearer to the receiver than this, 3 x 3 comparisons take the place of moments.");
    fields.real(
        "bleed_reduction", p.bleed_reduction, {0, 0.9}, "", "Fractions of light up to this one become dark; the rest is stretched.");
}

bool is_round(const scene::Light& light) { return light.kind() != scene::LightKind::rect; }

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::SoftMap soft = parts::draw_soft_map(passes, frame, params.soft);
        ResolveConstants c{.soft = soft.constants, .params = params};
        c.scene_radius = frame.resources.bounds().radius();
        c.kernel_scale = params.equal_area && is_round(frame.light) ? 0.5f * std::sqrt(std::numbers::pi_v<float>) : 1.0f;
        const gpu::ImageId sums = make_sums(passes, soft.map, params, c);
        const gpu::ImageId range = parts::build_min_max_pyramid(passes, soft.map.depth);

        const uint32_t search = uint32_t(params.subdivision == SUBDIVIDE_MIXED ? SUBDIVIDE_UNIFORM : params.subdivision);
        const uint32_t filter = uint32_t(params.subdivision == SUBDIVIDE_MIXED ? SUBDIVIDE_ADAPTIVE : params.subdivision);
        const gpu::SpecConstant modes[] = {{0, search}, {1, filter}, {2, uint32_t(params.per_cell)}};
        const auto array = [](gpu::ImageId image) { return gpu::Binding(image, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY); };
        parts::resolve_soft(passes, frame,
            params.sums == SUMS_INTEGER ? "techniques/vssm/vssm_integer.frag" : "techniques/vssm/vssm_float.frag", modes, c,
            {array(soft.map.depth), array(range), array(sums)});
    }

    /// The table of moments; sets what its lookups need.
    static gpu::ImageId make_sums(gpu::PassList& passes, const parts::LightMap& map, const Params& params, ResolveConstants& c)
    {
        const bool integer = params.sums == SUMS_INTEGER;
        const float size = float(params.soft.map_size);
        c.widest = std::max(params.widest * size, std::min(size, 16.0f));
        const int bits = parts::integer_sum_bits(double(c.widest) * double(c.widest));
        c.sum_step = parts::integer_sum_step(bits);

        const gpu::ImageDesc depth = passes.desc(map.depth);
        const gpu::ImageId values
            = passes.transient({VK_FORMAT_R32G32_SFLOAT, depth.size, depth.layers, 1, VK_SAMPLE_COUNT_1_BIT, false, "moments"});
        for (uint32_t layer = 0; layer < depth.layers; ++layer) {
            gpu::ColorTarget target{values, gpu::Load::discard};
            target.layer = layer;
            passes.fullscreen({.name = "moments",
                .program = &passes.device().raster_program("shaders/fullscreen.vert", "techniques/vssm/vssm_values.frag"),
                .bindings = {gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
                .constants
                = ValuesConstants{{map.constants.layers[layer], int(layer), integer ? PREFILTER_SUMS : PREFILTER_BOX}, c.sum_step},
                .colors = {target}});
        }
        return integer ? parts::build_integer_sums(passes, values, 2, bits) : parts::build_float_sums(passes, values, 2);
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
