// SPDX-License-Identifier: Apache-2.0
// Soft shadow mapping by back projection (Guennebaud et al. 2006) with bitmasks and microquads (Schwarz and Stamminger 2007).
#include "techniques/back_projection/back_projection.shared.h"

#include "gpu/device.h"
#include "shadow/parts/light_image.h"
#include "shadow/parts/light_samples.h"
#include "shadow/parts/n_buffer.h"
#include "shadow/parts/pyramid.h"
#include "shadow/parts/soft_map.h"
#include "shadow/technique.h"

#include <algorithm>
#include <map>

namespace gnomon::techniques::back_projection {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_soft(
        fields, p.soft, 3072); // two cubes of 4096 texels and their pyramid are more than 2 GiB, all that one image may take on lavapipe
    fields.integer("layers", p.layers, {1, 8}, "surfaces",
        "Surfaces behind one another that are kept of each texel: the first hides those behind it from the light's centre alone.");
    fields.choice("occluders", p.occluders, {"patches", "quads", "triangles", "mixed"},
        "What stands for the casters: a patch for each texel, quads between texel centres, quads with triangles where three of the four "
        "block, or patches of the finest level and quads of coarser ones.");
    fields.choice("accumulate", p.accumulate, {"area", "bitmask8", "bitmask16"},
        "How hidden parts of the light add up: as areas, which want one layer, since a body's near and far side would count twice; or as "
        "bits of 8 x 8 "
        "or 16 x 16 samples.");
    fields.choice("gaps", p.gaps, {"none", "neighbours"},
        "Whether a patch reaches to its blocking neighbours left of it and below, where their depths leave a gap; quads have none.");
    fields.choice("search", p.search, {"map", "window", "umbra"},
        "Texels looked at: all of the map (the definition, for which it has at most 256 a side: at 1024 a picture of 64 x 48 takes 80 s), "
        "those that can "
        "hide the light, or those and none where all of them block.");
    fields.choice("ranges", p.ranges, {"pyramid", "y_map", "multiscale"},
        "Where a window's least and greatest depth come from: the pyramid, of up to four times the window; a Y map, of the window rounded "
        "outwards to four texels; or a multiscale map, of the window, in eleven times the memory.");
    fields.choice("levels", p.levels, {"window", "casters"},
        "Levels of the pyramid that are read: one for a window, with the nearest depths, or one for each slice of casters, with the depths "
        "at "
        "the middles of its texels.");
    fields.integer("budget", p.budget, {4, 64}, "texels",
        "The finest level is taken that holds a window, or a slice's part of it, in so many texels a side.");
}

class BackProjection final : public TechniqueWith<Params> {
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& given) override
    {
        Params params = given;
        params.soft.fitting = parts::unwarped(params.soft.fitting);
        if (params.search == SEARCH_MAP) params.soft.map_size = std::min(params.soft.map_size, 256);
        const parts::SoftMap map = parts::draw_soft_map(passes, frame, params.soft);
        std::vector<gpu::ImageId> layers{map.map.depth};
        while (int(layers.size()) < params.layers)
            layers.push_back(parts::peel_light_map(passes, frame, map.map, parts::soft_map_settings(params.soft), layers.back()));
        const gpu::ImageId pyramid = parts::build_min_max_pyramid(passes, layers);
        parts::NBuffer windows{pyramid, {}};
        if (params.ranges != RANGES_PYRAMID)
            windows = parts::build_multiscale_map_of(passes, pyramid, params.ranges == RANGES_Y_MAP ? 2 : 0);
        constexpr uint32_t words[] = {0, 2, 8};
        const bool textured = frame.light.textured();
        const gpu::SpecConstant spec[] = {{0, uint32_t(params.occluders)}, {1, words[params.accumulate]}, {2, uint32_t(params.gaps)},
            {3, textured ? 1u : 0u}, {4, uint32_t(params.levels)}, {5, uint32_t(params.ranges)}};
        const bool disk = frame.light.kind() != scene::LightKind::rect;
        const int count = params.accumulate == 2 ? 256 : 64;
        const gpu::BufferId table = passes.import(samples(passes.device(), count, disk));
        parts::resolve_soft(passes, frame, map.map, "techniques/back_projection/back_projection_resolve.frag", spec,
            ResolveConstants{map.constants, params, windows.constants},
            {gpu::Binding(pyramid, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {table, gpu::Use::load},
                {textured ? passes.import(image(passes.device(), frame.light.image, count)) : table, gpu::Use::load},
                gpu::Binding(windows.image, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)});
    }

    gpu::Buffer& samples(gpu::Device& device, int count, bool disk)
    {
        const auto [found, fresh] = samples_.try_emplace({count, disk});
        if (fresh) {
            const auto table = parts::light_samples(count, disk).table;
            found->second = device.buffer({table.size() * sizeof(uint32_t), 0, gpu::Memory::device, "light samples"});
            device.upload(found->second, std::as_bytes(std::span(table)));
        }
        return found->second;
    }

    gpu::Buffer& image(gpu::Device& device, const scene::LightImage& image, int count)
    {
        const auto [found, fresh] = images_.try_emplace(count);
        if (fresh) {
            const auto table = parts::light_image_table(image, parts::light_samples(count, false).cells);
            found->second = device.buffer({table.size() * sizeof(vec4), 0, gpu::Memory::device, "light image"});
            device.upload(found->second, std::as_bytes(std::span(table)));
        }
        return found->second;
    }

    std::map<std::pair<int, bool>, gpu::Buffer> samples_;
    std::map<int, gpu::Buffer> images_; ///< of the one light, by the number of samples
};

} // namespace

} // namespace gnomon::techniques::back_projection

extern const gnomon::shadow::TechniqueInfo technique_back_projection;
const gnomon::shadow::TechniqueInfo technique_back_projection = {
    .id = "back_projection",
    .title = "Back projection",
    .family = "soft shadows",
    .cite = "Guennebaud, Barthe, Paulin 2006; Schwarz, Stamminger 2007",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::all_lights,
    .soft = true,
    .textured = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::back_projection::describe); },
    .create = [](gnomon::gpu::Device&) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::back_projection::BackProjection>();
    },
};
