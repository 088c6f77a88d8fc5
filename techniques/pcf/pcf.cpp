// SPDX-License-Identifier: Apache-2.0
// Percentage-closer filtering (Reeves, Salesin, Cook 1987) and the kernels, patterns and biases that came after.
#include "techniques/pcf/pcf.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/bias.h"
#include "shadow/parts/sample_patterns.h"
#include "shadow/technique.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::techniques::pcf {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_map(fields, p.map_size, p.fitting, 8192);
    fields.integer("kernel", p.kernel, {1, PCF_MAX_KERNEL}, "texels",
        "Width of the filter, n taps a side or a disk's diameter; at most a quarter of the map.");
    fields.choice("form", p.form, {"box", "gaussian", "bicubic", "poisson", "vogel"},
        "A grid of n x n taps (equal weights, Gaussian weights, or equal ones each a cubic B-spline), or a disk of scattered taps.");
    fields.flag("bilinear", p.bilinear, "Each tap blends 2 x 2 comparisons instead of taking the nearest texel (all forms but bicubic).");
    fields.integer(
        "taps", p.taps, {4, PCF_MAX_TAPS}, "", "Taps of a disk; poisson has 8 to 64; rounded up to fill the groups of interleave.");
    fields.choice("rotation", p.rotation, parts::rotations(), "Turns a disk by noise, another angle each pixel and frame.");
    fields.choice(
        "interleave", p.interleave, {"1", "2", "4"}, "Splits a disk's taps over k x k pixels, and averages those of one surface.");
    fields.flag("adaptive", p.adaptive, "A few outer taps come first, and decide where they agree.");
    fields.choice("window", p.window, {"fixed", "footprint"}, "Footprint: the filter is at least as wide as the pixel is in the map.");
    parts::describe_bias(fields, p.bias, false);
}

bool is_disk(const Params& p) { return p.form == PCF_POISSON || p.form == PCF_VOGEL; }

/// Texels between the farthest one read and half of the filter's width.
float beyond(const Params& p) { return is_disk(p) ? 1.0f : p.form == PCF_BICUBIC ? 1.5f : p.bilinear ? 0.5f : 0.0f; }

class Pcf final : public TechniqueWith<Params> {
public:
    explicit Pcf(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        ResolveConstants c{.view = view_constants(frame.view, frame.index),
            .light = light_constants(frame.light, frame.resources.bounds()),
            .params = params,
            .kernel = parts::filter_width(params.kernel, params.map_size),
            .groups = is_disk(params) ? 1 << params.interleave : 1};
        c.beyond = beyond(params);
        c.largest = params.window ? parts::filter_width(PCF_MAX_KERNEL, params.map_size) : c.kernel;
        set_taps(c);
        const parts::LightMap map = parts::draw_biased_map(passes, frame,
            {.size = params.map_size, .fitting = params.fitting, .guard_texels = 0.5f * float(c.largest) + c.beyond + 1.0f}, params.bias,
            0.5f * float(c.kernel) + c.beyond);
        c.map = map.constants;
        const bool noise = is_disk(params) && params.rotation == parts::rotate_blue_noise;
        if (noise && !noise_) noise_ = parts::blue_noise(device_);

        gpu::ImageId target = frame.output;
        if (c.groups > 1) {
            gpu::ImageDesc part = passes.desc(frame.output);
            part.name = "parts";
            target = passes.transient(part);
        }
        const uint32_t unrolled = !params.window && !is_disk(params) && c.kernel <= 9 ? uint32_t(c.kernel) : 0;
        const gpu::SpecConstant modes[] = {{0, uint32_t(params.form)}, {1, uint32_t(params.bilinear)}, {2, uint32_t(params.bias.kind)},
            {3, uint32_t(params.rotation)}, {4, uint32_t(params.adaptive)}, {5, uint32_t(params.window)}, {6, unrolled}};
        passes.fullscreen({.name = "resolve",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/pcf/pcf_resolve.frag", modes),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY),
                // any image where the shader does not look
                {noise ? passes.import(noise_) : frame.gbuffer.depth, gpu::Use::sample}},
            .constants = parts::with_map(c, map, offsetof(ResolveConstants, map)),
            .colors = {{target}}});
        if (c.groups == 1) return;
        passes.fullscreen({.name = "gather",
            .program = &device_.raster_program("shaders/fullscreen.vert", "techniques/pcf/pcf_gather.frag"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {target, gpu::Use::sample}},
            .constants = GatherConstants{c.view, c.groups},
            .colors = {{frame.output}}});
    }

    void set_taps(ResolveConstants& c)
    {
        if (!is_disk(c.params)) return;
        const bool poisson = c.params.form == PCF_POISSON;
        const int wanted = poisson ? std::clamp(c.params.taps, 8, 64) : c.params.taps, group = c.groups * c.groups;
        c.taps = (wanted + group - 1) / group * group;
        if (disk_form_ != c.params.form || int(disk_.size()) != c.taps)
            disk_form_ = c.params.form, disk_ = poisson ? parts::poisson_disk(c.taps) : parts::vogel_disk(c.taps);
        std::copy(disk_.begin(), disk_.end(), c.disk);
    }

    gpu::Device& device_;
    gpu::Image noise_; ///< made when first asked for
    int disk_form_ = -1;
    std::vector<vec2> disk_;
};

} // namespace

} // namespace gnomon::techniques::pcf

extern const gnomon::shadow::TechniqueInfo technique_pcf;
const gnomon::shadow::TechniqueInfo technique_pcf = {
    .id = "pcf",
    .title = "Percentage-closer filtering",
    .family = "shadow maps",
    .cite = "Reeves, Salesin, Cook 1987",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::pcf::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::pcf::Pcf>(device);
    },
};
