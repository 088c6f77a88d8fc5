// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/prefiltered_soft.h"

#include "shadow/parts/pyramid.h"
#include "shadow/parts/summed_area_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::shadow::parts {

namespace {

gpu::Binding array(gpu::ImageId image) { return gpu::Binding(image, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY); }

int bits_of(const PrefilteredSoftMap& map) { return integer_sum_bits(std::pow(double(map.constants.widest), 2.0)); }

} // namespace

void describe_prefiltered_soft(Fields& fields, shaders::PrefilteredSoftParams& p, int largest)
{
    describe_soft(fields, p.soft, largest);
    fields.choice("sums", p.sums, {"integer", "float"},
        "Summed-area table of 32-bit integers, exact for windows of up to `widest`, or of 32-bit floats.");
    fields.real("widest", p.widest, {0.02, 0.5}, "of the map",
        "Side of the widest window; larger ones are cut down to it. Integers have 32 bits less those that count a window's texels.");
    fields.choice("kernel", p.equal_area, {"circumscribed", "equal_area"},
        "The square that stands for a round light: around its disk, or of the disk's area.");
    fields.real("contact", p.contact, {0, 0.2}, "scene radius",
        "Where blockers are nearer to the receiver than this, 3 x 3 comparisons take the place of averages.");
}

PrefilteredSoftMap draw_prefiltered_soft(gpu::PassList& passes, const Frame& frame, const shaders::PrefilteredSoftParams& params)
{
    PrefilteredSoftMap out;
    out.soft = draw_soft_map(passes, frame, params.soft);
    out.range = build_min_max_pyramid(passes, out.soft.map.depth);
    const float size = float(params.soft.map_size);
    out.constants.widest = std::max(params.widest * size, std::min(size, 16.0f));
    out.constants.sum_step = integer_sum_step(bits_of(out));
    out.constants.contact = params.contact * frame.resources.bounds().radius();
    const bool round = frame.light.kind() != scene::LightKind::rect;
    out.constants.kernel_scale = params.equal_area && round ? 0.5f * std::sqrt(std::numbers::pi_v<float>) : 1.0f;
    return out;
}

gpu::ImageId sum_values(
    gpu::PassList& passes, const PrefilteredSoftMap& map, const shaders::PrefilteredSoftParams& params, const ValuesPass& pass)
{
    const bool integer = params.sums == SUMS_INTEGER;
    const gpu::ImageId values = draw_values(passes, map.soft.map, integer ? PREFILTER_SUMS : PREFILTER_BOX, pass);
    const int channels = channels_of(pass.format);
    return integer ? build_integer_sums(passes, values, channels, bits_of(map)) : build_float_sums(passes, values, channels);
}

void resolve_prefiltered_soft(gpu::PassList& passes, const Frame& frame, const PrefilteredSoftMap& map, std::string_view shader,
    std::span<const gpu::SpecConstant> spec, gpu::Constants constants, std::vector<gpu::Binding> more)
{
    more.insert(more.begin(), {array(map.soft.map.depth), array(map.range)});
    resolve_soft(passes, frame, map.soft.map, shader, spec, std::move(constants), std::move(more), true);
}

} // namespace gnomon::shadow::parts
