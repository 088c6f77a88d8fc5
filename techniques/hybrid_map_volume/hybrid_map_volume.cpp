// SPDX-License-Identifier: Apache-2.0
// A shadow map where its texels agree, an exact method where they do not (Chan, Durand 2004).
#include "techniques/hybrid_map_volume/hybrid_map_volume.shared.h"

#include "base/error.h"
#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"
#include "shadow/technique.h"

#include <cstddef>

namespace gnomon::techniques::hybrid_map_volume {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    parts::describe_map(fields, p.map_size, p.fitting, 8192);
    fields.integer("reach", p.reach, {1, 8}, "texels",
        "How far around a receiver's texel all others must agree with it: features of the shadow narrower than that may be missed.");
    fields.real("bias_scale", p.bias_scale, {0, 64}, "",
        "Times the depth before a receiver's plane, one metre a metre up to the farthest texel, in which a texel says nothing.");
    fields.choice("exact", p.exact, {"rays"}, "What decides the pixels at which texels disagree: a ray each.");
    fields.choice("culling", p.culling, {"none", "frustum", "receivers"},
        "Which instances are not drawn into the map: none; those outside of a layer; or, under a sun, all that lie between it and no "
        "receiver that is seen. Pictures are the same.");
}

std::string unavailable(const gpu::Device& device)
{
    if (device.info().ray_query) return {};
    return "the device has no ray queries, which decide the pixels at a shadow's edge; use shadow_map, or alias_free for exact shadows "
           "without rays";
}

struct Marked {
    gpu::BufferId pixels, groups; ///< the list, a count first; the groups of a pass over it
    HybridConstants constants;
};

class Hybrid final : public TechniqueWith<Params> {
public:
    explicit Hybrid(gpu::Device& device)
        : device_(device)
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const Marked marked = decide(passes, frame, params);
        if (frame.counters) frame.counters->push_back({"boundary_pixels", marked.pixels, 0});
        trace(passes, frame, marked);
    }

    Marked decide(gpu::PassList& passes, const Frame& frame, const Params& params)
    {
        const uint64_t bytes = 4 * (1 + uint64_t(frame.view.size.area())), limit = device_.limits().maxStorageBufferRange;
        if (bytes > limit || frame.view.size.width > 0xffff || frame.view.size.height > 0xffff)
            base::fail("hybrid_map_volume lists up to {} pixels of {}x{}, more than a buffer of {} bytes takes; choose a smaller --size",
                frame.view.size.area(), frame.view.size.width, frame.view.size.height, limit);
        const parts::LightMapSettings settings{.size = params.map_size,
            .fitting = params.fitting,
            .culling = parts::Culling(params.culling),
            .guard_texels = float(params.reach) + 1.5f};
        const parts::LightMap map = parts::draw_light_map(passes, frame, settings);
        Marked marked;
        marked.pixels = passes.transient(gpu::BufferDesc{bytes, 0, gpu::Memory::device, "marked pixels"});
        marked.groups
            = passes.transient(gpu::BufferDesc{sizeof(Dispatch), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, gpu::Memory::device, "groups"});
        marked.constants = {view_constants(frame.view, frame.index), light_constants(frame.light, frame.resources.bounds()), map.constants,
            params.bias_scale};
        passes.fill(marked.pixels, 0, "no pixels");
        passes.fill(marked.groups, 0, "no groups");
        const gpu::SpecConstant reach[] = {{0, uint32_t(params.reach)}};
        passes.fullscreen({.name = "decide",
            .program
            = &device_.raster_program("shaders/fullscreen.vert", "techniques/hybrid_map_volume/hybrid_map_volume_decide.frag", reach),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {marked.pixels, gpu::Use::update},
                {marked.groups, gpu::Use::update}},
            .constants = parts::with_map(marked.constants, map, offsetof(HybridConstants, map)),
            .colors = {{frame.output}}});
        return marked;
    }

    void trace(gpu::PassList& passes, const Frame& frame, const Marked& marked)
    {
        SceneGpu& scene = frame.resources;
        passes.compute({.name = "rays",
            .program = &device_.compute_program("techniques/hybrid_map_volume/hybrid_map_volume_rays.comp"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {frame.output, gpu::Use::store},
                scene.tlas(), {passes.import(scene.instances()), gpu::Use::load}, {passes.import(scene.materials()), gpu::Use::load},
                {passes.import(scene.indices()), gpu::Use::load}, {passes.import(scene.attributes()), gpu::Use::load},
                {marked.pixels, gpu::Use::load}},
            .constants = marked.constants,
            .textures = &scene.textures(),
            .indirect = marked.groups});
    }

    gpu::Device& device_;
};

} // namespace

} // namespace gnomon::techniques::hybrid_map_volume

extern const gnomon::shadow::TechniqueInfo technique_hybrid_map_volume;
const gnomon::shadow::TechniqueInfo technique_hybrid_map_volume = {
    .id = "hybrid_map_volume",
    .title = "Hybrid of shadow map and exact shadows",
    .family = "hard shadows",
    .cite = "Chan, Durand 2004",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .counts = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::hybrid_map_volume::describe); },
    .unavailable = gnomon::techniques::hybrid_map_volume::unavailable,
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::hybrid_map_volume::Hybrid>(device);
    },
};
