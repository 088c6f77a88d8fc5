// SPDX-License-Identifier: Apache-2.0
// Percentage-closer soft shadows (Fernando 2005), and what came after: bias cone and centred search (Burley 2006), filtering by summed-area
// variance shadow maps (Lauritzen 2007).
#include "techniques/pcss/pcss.shared.h"

#include "shadow/parts/filtered_map.h"
#include "shadow/parts/pyramid.h"
#include "shadow/parts/sample_patterns.h"
#include "shadow/parts/soft_map.h"
#include "shadow/technique.h"

#include <algorithm>

namespace gnomon::techniques::pcss {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_soft(fields, p.soft);
    fields.choice("pattern", p.pattern, {"grid", "poisson", "vogel"},
        "Where both steps look: all texels of the window, or scattered taps; boxes for rectangles, else disks.");
    fields.integer("search_taps", p.search_taps, {4, PCSS_MAX_SEARCH_TAPS}, "", "Taps of the blocker search; poisson has 8 or more.");
    fields.integer(
        "filter_taps", p.filter_taps, {4, PCSS_MAX_FILTER_TAPS}, "", "Taps of the filter, each of 2 x 2 texels; poisson has 8 to 64.");
    fields.choice("rotation", p.rotation, parts::rotations(), "Moves the taps by noise, otherwise each pixel and frame.");
    fields.integer("refine", p.refine, {0, 4}, "",
        "How often the search window, at first that of the near plane, shrinks to that of the nearest depth in it.");
    fields.flag("centred", p.centred, "Blockers near the window's centre count more for the mean depth.");
    fields.choice("filtering", p.filtering, {"pcf", "vsm_sums"},
        "The second step: percentage-closer filtering, or Chebyshev's inequality over a summed-area table.");
    fields.choice("shortcut", p.shortcut, {"none", "lit", "both"},
        "Windows that the pyramid shows to be lit, or also those that it shows to be blocked, are not looked at further.");
    fields.choice("receiver", p.receiver, {"receiver_plane", "cone"},
        "What a texel is compared with: the receiver's plane there, or a depth nearer to the light the farther off.");
    fields.real("bias_cone", p.bias_cone, {0, 64}, "",
        "cone: metres of depth a metre between texel and receiver, where the receiver's own slope is less.");
    fields.real("least", p.least, {0.5, 16}, "texels", "Windows of lights with a size are no narrower.");
    fields.integer("cap", p.cap, {1, 1024}, "texels", "Windows are no wider; at most a quarter of the map.");
}

class Pcss final : public TechniqueWith<Params> {
public:
    explicit Pcss(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::SoftMap soft = parts::draw_soft_map(passes, frame, params.soft);
        const bool box = frame.light.kind() == scene::LightKind::rect;
        ResolveConstants c{.soft = soft.constants, .params = params};
        c.params.cap = parts::filter_width(params.cap, params.soft.map_size);
        c.params.least = std::min(params.least, float(c.params.cap));
        if (params.pattern != PCSS_GRID) {
            c.params.search_taps = fill_taps(search_, c.search, params.pattern, params.search_taps, box);
            c.params.filter_taps = fill_taps(filter_, c.taps, params.pattern, params.filter_taps, box);
        }
        const bool pyramid = params.refine > 0 || params.shortcut != PCSS_SHORTCUT_NONE;
        const bool noise = params.pattern != PCSS_GRID && params.rotation == parts::rotate_blue_noise;
        if (noise && !noise_) noise_ = parts::blue_noise(device_);
        const gpu::SpecConstant spec[] = {{0, uint32_t(params.pattern)}, {1, uint32_t(params.rotation)}, {2, uint32_t(box)},
            {3, uint32_t(params.receiver == PCSS_CONE)}, {4, uint32_t(params.centred)}, {5, uint32_t(params.shortcut)},
            {6, uint32_t(params.filtering)}};
        const gpu::ImageId sums = make_sums(passes, frame, soft.map, c);
        // any image where the shader does not look
        parts::resolve_soft(passes, frame, soft.map, "techniques/pcss/pcss_resolve.frag", spec, c,
            {gpu::Binding(soft.map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                {noise ? passes.import(noise_) : frame.gbuffer.depth, gpu::Use::sample},
                gpu::Binding(pyramid ? parts::build_min_max_pyramid(passes, soft.map.depth) : soft.map.depth, gpu::Use::sample)
                    .as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                gpu::Binding(sums, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
            true);
    }

    static gpu::ImageId make_sums(gpu::PassList& passes, const Frame& frame, const parts::LightMap& map, ResolveConstants& c)
    {
        if (c.params.filtering != PCSS_FILTER_SUMS) {
            const gpu::ImageId none = passes.transient({VK_FORMAT_R32_UINT, {1, 1}, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "no sums"});
            passes.clear(none, {});
            return none;
        }
        // sums are exact in windows twice as wide as the kernel
        const FilterParams filter{.map_size = c.params.soft.map_size, .kernel = (c.params.cap + 1) / 2, .prefilter = PREFILTER_SUMS};
        const parts::FilteredMap filtered = parts::filter_map(passes, frame, map, filter,
            {.shader = "techniques/pcss/pcss_values.frag", .constants = [](const FilterValues& values) { return values; }});
        c.sum_step = filtered.constants.sum_step;
        return filtered.sums;
    }

    /// A disk made before: candidates for Poisson disks take milliseconds.
    struct Disk {
        int pattern = -1;
        std::vector<vec2> points;
    };

    /// Returns how many.
    static int fill_taps(Disk& disk, std::span<vec2> taps, int pattern, int wanted, bool box)
    {
        const bool poisson = pattern == PCSS_POISSON;
        const int count = poisson ? std::clamp(wanted, 8, 64) : wanted;
        if (disk.pattern != pattern || int(disk.points.size()) != count)
            disk = {pattern, poisson ? parts::poisson_disk(count) : parts::vogel_disk(count)};
        std::transform(disk.points.begin(), disk.points.end(), taps.begin(), [&](vec2 p) { return box ? parts::disk_to_square(p) : p; });
        return count;
    }

    gpu::Device& device_;
    Disk search_, filter_;
    gpu::Image noise_; ///< made when first asked for
};

} // namespace

} // namespace gnomon::techniques::pcss

extern const gnomon::shadow::TechniqueInfo technique_pcss;
const gnomon::shadow::TechniqueInfo technique_pcss = {
    .id = "pcss",
    .title = "Percentage-closer soft shadows",
    .family = "soft shadows",
    .cite = "Fernando 2005",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::pcss::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::pcss::Pcss>(device);
    },
};
