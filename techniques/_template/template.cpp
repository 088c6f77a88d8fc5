// SPDX-License-Identifier: Apache-2.0
// A plain shadow map to start from: replace what is here by the technique, and name its paper.
#include "techniques/template_id/template_id.shared.h"

#include "shadow/light_constants.h"
#include "shadow/parts/light_map.h"
#include "shadow/technique.h"

#include <cstddef>

namespace gnomon::techniques::template_id {

namespace {

using namespace shadow;

void describe(Params& p, Fields& fields)
{
    fields.integer("map_size", p.map_size, {16, 8192}, "texels", "Width and height of each depth layer.");
    fields.real("normal_offset", p.normal_offset, {0, 16}, "texels", "Distance by which a receiver is moved along its normal.");
}

class Method final : public TechniqueWith<Params> {
public:
    explicit Method(gpu::Device& device)
        : resolve_(device.raster_program("shaders/fullscreen.vert", "techniques/template_id/template_id_resolve.frag"))
    {
    }

private:
    void record_with(gpu::PassList& passes, const Frame& frame, const Params& params) override
    {
        const parts::LightMap map = parts::draw_light_map(passes, frame, {.size = params.map_size, .slope_bias = 1.0f});
        passes.fullscreen({.name = "resolve",
            .program = &resolve_,
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample},
                gpu::Binding(map.depth, gpu::Use::sample, gpu::Sampler::compare_nearest).as(VK_IMAGE_VIEW_TYPE_2D_ARRAY)},
            .constants = parts::with_map(ResolveConstants{view_constants(frame.view, frame.index),
                                             light_constants(frame.light, frame.resources.bounds()), map.constants, params},
                map, offsetof(ResolveConstants, map)),
            .colors = {{frame.output}}});
    }

    const gpu::Program& resolve_;
};

} // namespace

} // namespace gnomon::techniques::template_id

extern const gnomon::shadow::TechniqueInfo technique_template_id;
const gnomon::shadow::TechniqueInfo technique_template_id = {
    .id = "template_id",
    .title = "template_id",
    .family = "shadow maps",
    .cite = "Author year",
    .output = gnomon::shadow::Output::visibility,
    .lights = gnomon::shadow::directional_lights | gnomon::shadow::spot_lights | gnomon::shadow::point_lights,
    .params = [] { return gnomon::shadow::param_table(gnomon::techniques::template_id::describe); },
    .create = [](gnomon::gpu::Device& device) -> std::unique_ptr<gnomon::shadow::Technique> {
        return std::make_unique<gnomon::techniques::template_id::Method>(device);
    },
};
