// SPDX-License-Identifier: Apache-2.0
// Convolution soft shadow maps (Annen, Dong, Mertens, Bekaert, Seidel, Kautz 2008).
#include "techniques/cssm/cssm_series.h"

#include "shadow/parts/prefiltered_soft.h"
#include "shadow/parts/pyramid.h"
#include "shadow/technique.h"

namespace gnomon::techniques::cssm {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_prefiltered_soft(fields, p.prefiltered, 2048);
    fields.integer("terms", p.terms, {2, 16}, "",
        "Terms of the Fourier series; each stores a sine and a cosine, and both times depth. Odd numbers count as the next even one.");
    fields.choice("prefilter", p.prefilter, {"sums", "mips"},
        "How windows are averaged: by summed-area tables of 32 bits, or by mips of 8 bits (of 16 times depth), read trilinearly.");
    fields.choice("format", p.format, {"u8", "u16"}, "Bits of each stored sine and cosine in mips; those times depth always have 16.");
    fields.choice("range", p.tight, {"fit", "tight"},
        "The depths that the series spans begin at the layer's near plane, or at the nearest depth in its map.");
    fields.integer("iterations", p.iterations, {0, 3}, "",
        "How often the blockers' depth is averaged again, over the window that the light cuts out at the last average.");
    fields.real("least", p.least, {0, 0.5}, "", "A smaller blocked fraction of the search window is none.");
    fields.choice("correction", p.correction, {"none", "sharpen", "level"},
        "Against light contacts: nothing; the lit fraction to the power 1 + sharpening exp(-reach (receiver's depth - blockers' depth)); "
        "or "
        "the darkness taken into account that the series has at the blockers' depth.");
    fields.real("sharpening", p.sharpening, {0, 100}, "", "Of the power that darkens contacts, at the contact.");
    fields.real("reach", p.reach, {1, 100}, "1 / depth range", "Of that power: how fast it falls with the distance to the blockers.");
}

struct Waves {
    gpu::ImageId waves, depth_waves, depth; // sums or mips
};

Waves prefilter(gpu::PassList& passes, const parts::PrefilteredSoftMap& map, const Params& params, const Series& series)
{
    const bool mips = params.prefilter == CSSM_MIPS;
    const auto average = [&](const char* shader, VkFormat format, int groups, int outputs, int times_depth) {
        const parts::ValuesPass pass{.shader = shader,
            .format = format,
            .groups = groups,
            .outputs = outputs,
            .with_mips = mips,
            .more = {gpu::Binding(map.range, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
            .constants = [&, times_depth](const FilterValues& layer) {
                return ValuesConstants{layer, series, params.tight, times_depth};
            }};
        if (!mips) return parts::sum_values(passes, map, params.prefiltered, pass);
        const gpu::ImageId values = parts::draw_values(passes, map.soft.map, PREFILTER_MIPS, pass);
        parts::fill_mean_pyramid(passes, values);
        return values;
    };
    const VkFormat wide = VK_FORMAT_R16G16B16A16_UNORM;
    const char* waves = "techniques/cssm/cssm_waves.frag";
    return {average(waves, mips && params.format == 0 ? VK_FORMAT_R8G8B8A8_UNORM : wide, series.groups, 8, 0),
        average(waves, wide, series.groups, 8, 1), average("techniques/cssm/cssm_depth.frag", VK_FORMAT_R32_SFLOAT, 1, 1, 1)};
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::PrefilteredSoftMap map = parts::draw_prefiltered_soft(passes, frame, params.prefiltered);
        const bool mips = params.prefilter == CSSM_MIPS, integer = params.prefiltered.sums == SUMS_INTEGER;
        const double quantum = mips && params.format == 0 ? 1.0 / 255 : integer ? double(map.constants.sum_step) : 1.0 / 65535;
        const Series series = make_series(params.terms, quantum);
        const Waves waves = prefilter(passes, map, params, series);

        const gpu::SpecConstant spec[] = {{0, uint32_t(series.groups)}, {1, uint32_t(params.correction)}, {2, uint32_t(params.iterations)}};
        const auto read = [](gpu::ImageId image) {
            return gpu::Binding(image, gpu::Use::sample, gpu::Sampler::linear_clamp).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY);
        };
        parts::resolve_prefiltered_soft(passes, frame, map,
            mips          ? "techniques/cssm/cssm_mips.frag"
                : integer ? "techniques/cssm/cssm_integer.frag"
                          : "techniques/cssm/cssm_float.frag",
            spec, ResolveConstants{map.soft.constants, map.constants, params, series},
            {read(waves.waves), read(waves.depth_waves), read(waves.depth)});
    }
};

} // namespace

} // namespace gnomon::techniques::cssm

extern const gnomon::shadow::TechniqueInfo technique_cssm;
const gnomon::shadow::TechniqueInfo technique_cssm = {
    .id = "cssm",
    .title = "Convolution soft shadow maps",
    .family = "soft shadows",
    .cite = "Annen, Dong, Mertens, Bekaert, Seidel, Kautz 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::cssm::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::cssm::Method>();
    },
};
