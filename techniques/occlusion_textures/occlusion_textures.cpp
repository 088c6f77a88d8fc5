// SPDX-License-Identifier: Apache-2.0
// Soft shadows by occlusion textures (Eisemann and Décoret 2006).
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

#include "shadow/parts/fit.h"
#include "shadow/parts/fullscreen_layers.h"
#include "shadow/parts/n_buffer.h"
#include "shadow/parts/pyramid.h"
#include "shadow/parts/soft_map.h"
#include "shadow/parts/summed_area_table.h"
#include "shadow/technique.h"
#include "techniques/occlusion_textures/slices.h"

#include <cmath>
#include <numbers>

namespace gnomon::techniques::occlusion_textures {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_soft(fields, p.soft, 2048);
    fields.integer("slices", p.slices, {1, SLICES_MAX}, "", "Slices that each layer's depth is cut into.");
    fields.choice("placement", p.placement, {"uniform", "logarithmic", "fitted"},
        "How depth is cut: evenly; by equal factors, where the light is a point; or so that what the scene's objects hold lies near the "
        "end of "
        "its slice.");
    fields.choice("plane", p.middle, {"end", "middle"},
        "Where a slice's content is taken to lie: at its end, or in its middle for receivers that are far enough behind it.");
    fields.choice("prefilter", p.prefilter, {"sums", "n_buffer", "mips"},
        "Means over windows: exact, from summed-area tables; of squares, from N-buffers of 8 bits; or of squares, from mip levels.");
    fields.choice("fusion", p.fusion, {"product", "sum", "max", "mean", "joined"},
        "What slices hide together: as if independently of one another; all beside one another; all behind the greatest; or the mean of "
        "the "
        "last two.");
    fields.choice("own", p.own, {"none", "compare"},
        "What the receiver's own slice hides: nothing; or what percentage-closer soft shadows make of its nearest content.");
    fields.choice("kernel", p.equal_area, {"circumscribed", "equal_area"},
        "The square that stands for a round light: around its disk, or of the disk's area.");
}

gpu::Binding array_of(gpu::ImageId image, gpu::Sampler sampler = gpu::Sampler::nearest_clamp)
{
    return gpu::Binding(image, gpu::Use::sample, sampler).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY);
}

/// The texels' content: group g of the map's layer l in layer g * layers + l.
gpu::ImageId draw_slices(gpu::PassList& passes, const Frame& frame, const Params& params, const LightMap& map, const Slices& slices)
{
    const parts::LightMapSettings settings = parts::soft_map_settings(params.soft);
    const uint32_t groups = (uint32_t(params.slices) + 3) / 4;
    const gpu::ImageId image = passes.transient(
        {VK_FORMAT_R8G8B8A8_UNORM, {settings.size, settings.size}, groups * map.layer_count, 1, VK_SAMPLE_COUNT_1_BIT, false, "slices"});
    DrawConstants c{};
    for (uint32_t l = 0; l < map.layer_count; ++l) c.clip_from_world[l] = parts::clip_from_world(map.layers[l]);
    c.slices = slices;
    c.size = float(settings.size);
    for (uint32_t l = 0; l < map.layer_count; ++l) {
        c.front[l] = vec3(0, 0, 1);
        // the plane holds the eye, so that the layer sees it as a line: as a plane of map space it does not ask for the depth
        for (const vec4& plane : panel_plane(frame.light)) {
            const vec4 in_map = glm::inverse(glm::transpose(map.layers[l].map_from_world)) * plane;
            c.front[l] = vec3(in_map.x, in_map.y, in_map.w);
        }
    }
    gpu::RasterPass pass;
    pass.name = "slices";
    pass.program = &passes.device().raster_program(
        "techniques/occlusion_textures/occlusion_textures_casters.vert", "techniques/occlusion_textures/occlusion_textures_casters.frag");
    pass.constants = c;
    VkPipelineColorBlendAttachmentState keep_greatest{};
    keep_greatest.blendEnable = VK_TRUE;
    keep_greatest.srcColorBlendFactor = keep_greatest.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
    keep_greatest.srcAlphaBlendFactor = keep_greatest.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    keep_greatest.colorBlendOp = keep_greatest.alphaBlendOp = VK_BLEND_OP_MAX;
    keep_greatest.colorWriteMask = 0xf;
    for (uint32_t g = 0; g < SLICE_GROUPS; ++g) {
        gpu::ColorTarget target;
        if (g < groups) target.image = image;
        target.layer = g * map.layer_count;
        target.blend = keep_greatest;
        pass.colors.push_back(target);
    }
    parts::draw_casters(passes, frame, map, settings, std::move(pass),
        passes.device().raster_program("techniques/occlusion_textures/occlusion_textures_masked.vert",
            "techniques/occlusion_textures/occlusion_textures_masked.frag"));
    return image;
}

gpu::ImageId build_sums(gpu::PassList& passes, gpu::ImageId slices, GroupConstants c)
{
    const gpu::ImageDesc desc = passes.desc(slices);
    return parts::build_word_sums(passes, {array_of(slices)}, desc.size, uint32_t((c.groups + 1) / 2 * c.layers),
        "techniques/occlusion_textures/occlusion_textures_rows.comp", c);
}

/// 1 where a slice covers a texel, with `mips` levels of which the first is filled.
gpu::ImageId make_cover(gpu::PassList& passes, gpu::ImageId slices, GroupConstants c, uint32_t mips)
{
    gpu::ImageDesc desc = passes.desc(slices);
    desc.mips = mips, desc.name = "cover";
    const gpu::ImageId cover = passes.transient(desc);
    parts::fullscreen_layers(passes,
        {"cover",
            &passes.device().raster_program(
                "shaders/fullscreen_layers.vert", "techniques/occlusion_textures/occlusion_textures_cover.frag"),
            {array_of(slices)}, c, {{cover, gpu::Load::discard}}},
        desc.layers);
    return cover;
}

class Method final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        parts::LightMapSettings settings = parts::soft_map_settings(params.soft);
        settings.fitting = parts::unwarped(settings.fitting);
        const LightMap map = parts::fit_light_map(frame.scene, frame.resources.bounds(), frame.view, frame.light, settings);
        if (frame.light_map) *frame.light_map = map;
        ResolveConstants c{};
        c.soft = parts::soft_constants(frame, map, params.soft);
        c.params = params;
        c.slices = place_slices(caster_boxes(frame.scene), map, panel_plane(frame.light), params.slices, params.placement);
        const bool round = frame.light.kind() != scene::LightKind::rect;
        c.kernel_scale = params.equal_area && round ? 0.5f * std::sqrt(std::numbers::pi_v<float>) : 1.0f;
        const gpu::ImageId slices = draw_slices(passes, frame, params, map, c.slices);

        const GroupConstants groups{int(map.layer_count), (params.slices + 3) / 4, params.fusion == FUSE_JOINED ? 1 : 0};
        gpu::ImageId filtered;
        if (params.prefilter == PREFILTER_SUMS) {
            filtered = build_sums(passes, slices, groups);
        } else if (params.prefilter == PREFILTER_N_BUFFER) {
            const parts::NBuffer buffer = parts::build_mean_n_buffer(
                passes, make_cover(passes, slices, groups, 1), VK_FORMAT_R8G8B8A8_UNORM, parts::n_buffer_levels(settings.size / 4));
            filtered = buffer.image, c.n_buffer = buffer.constants;
        } else {
            filtered = make_cover(passes, slices, groups, parts::pyramid_levels(passes.desc(slices).size));
            parts::fill_mean_pyramid(passes, filtered);
        }
        const bool sums = params.prefilter == PREFILTER_SUMS;
        const gpu::SpecConstant spec[] = {{0, uint32_t(params.slices)}, {1, uint32_t(params.fusion)}, {2, uint32_t(params.own)},
            {3, uint32_t(params.middle)}, {4, params.prefilter == PREFILTER_MIPS ? 1u : 0u}};
        parts::resolve_soft(passes, frame, {{}, map},
            sums ? "techniques/occlusion_textures/occlusion_textures_sums.frag"
                 : "techniques/occlusion_textures/occlusion_textures_means.frag",
            spec, c, {array_of(slices), array_of(filtered, sums ? gpu::Sampler::nearest_clamp : gpu::Sampler::linear_clamp)});
    }
};

} // namespace

} // namespace gnomon::techniques::occlusion_textures

extern const gnomon::shadow::TechniqueInfo technique_occlusion_textures;
const gnomon::shadow::TechniqueInfo technique_occlusion_textures = {
    .id = "occlusion_textures",
    .title = "Occlusion textures",
    .family = "soft shadows",
    .cite = "Eisemann, Décoret 2006, 2008",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::occlusion_textures::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::occlusion_textures::Method>();
    },
};
