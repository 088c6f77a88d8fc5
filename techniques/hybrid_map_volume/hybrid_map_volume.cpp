// SPDX-License-Identifier: Apache-2.0
// A shadow map where its texels agree, an exact method where they do not (Chan, Durand 2004).
#include "techniques/hybrid_map_volume/hybrid_map_volume.shared.h"

#include "base/error.h"
#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"
#include "shadow/parts/volume_culling.h"
#include "shadow/parts/volumes.h"
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
    fields.choice("exact", p.exact, {"rays", "volumes"},
        "What decides the pixels at which texels disagree: a ray each, where the device has ray queries; or shadow volumes, by which "
        "masked casters are solid.");
    fields.choice("culling", p.culling, {"none", "frustum", "receivers"},
        "Which instances are not drawn into the map: none; those outside of a layer; or, under a sun, all that lie between it and no "
        "receiver that is seen. Pictures are the same.");
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
        const bool rays = params.exact == 0 && device_.info().ray_query;
        const gpu::ImageId decided = rays
            ? frame.output
            : passes.transient(gpu::ImageDesc{VK_FORMAT_R32_SFLOAT, frame.view.size, 1, 1, VK_SAMPLE_COUNT_1_BIT, false, "decided"});
        const Marked marked = decide(passes, frame, params, decided, !rays);
        if (frame.counters) frame.counters->push_back({"boundary_pixels", marked.pixels, 0});
        if (rays)
            trace(passes, frame, marked);
        else
            count_volumes(passes, frame, decided);
    }

    /// `left_open`: marked pixels are -1.
    Marked decide(gpu::PassList& passes, const Frame& frame, const Params& params, gpu::ImageId decided, bool left_open)
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
        const gpu::SpecConstant modes[] = {{0, uint32_t(params.reach)}, {1, left_open ? 1u : 0u}};
        passes.fullscreen({.name = "decide",
            .program
            = &device_.raster_program("shaders/fullscreen.vert", "techniques/hybrid_map_volume/hybrid_map_volume_decide.frag", modes),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY), {marked.pixels, gpu::Use::update},
                {marked.groups, gpu::Use::update}},
            .constants = parts::with_map(marked.constants, map, offsetof(HybridConstants, map)),
            .colors = {{decided}}});
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

    /// Of casters alone that may darken a marked pixel.
    void count_volumes(gpu::PassList& passes, const Frame& frame, gpu::ImageId decided)
    {
        parts::VolumeSettings settings{.decided = decided};
        parts::CulledVolumes culled;
        if (!frame.view.orthographic) { // see cull_volumes
            culled = parts::cull_volumes(passes, frame, {.casters = false, .max = false, .clamp = true, .decided = decided});
            settings.slot_bands = culled.slots, settings.bands = &culled.bands;
        }
        parts::resolve_volumes(passes, frame, settings, parts::count_volumes(passes, frame, casters_, settings));
    }

    uint64_t kept_bytes() const override { return casters_.bytes(); }

    gpu::Device& device_;
    parts::VolumeCasters casters_; ///< made when first asked for
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
    .reads_vertices = true,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::hybrid_map_volume::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::hybrid_map_volume::Hybrid>(device);
    },
};
