// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volume_outlines.h"

#include "shadow/light_constants.h"
#include "shadow/parts/volume_faces.h"
#include "src/shadow/parts/volume_outlines.shared.h"

#include <cstddef>

namespace gnomon::shadow::parts {

namespace {

using gpu::Use;

/// `sides`: along the light's rays, else the silhouettes.
void draw_lines(gpu::PassList& passes, const Frame& frame, const VolumeFaces& faces, gpu::ImageId out, bool sides, gpu::Load load)
{
    shaders::VolumeOutlines c{};
    c.view = faces.task.view, c.light = faces.task.light;
    c.reach = 2.0f * frame.resources.bounds().radius();
    c.half_width = sides ? 0.5f : 0.75f;
    c.opacity = sides ? 0.25f : 1.0f, c.hidden = sides ? 0.08f : 0.3f;
    c.color = sides ? vec3(0.35f, 0.65f, 1.0f) : vec3(1.0f, 0.85f, 0.1f);
    const gpu::SpecConstant modes[] = {{0, sides ? 1u : 0u}};
    const VkPipelineColorBlendAttachmentState over{VK_TRUE, VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD,
        VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA, VK_BLEND_OP_ADD, 0xf};
    passes.raster({.name = sides ? "volumes' sides" : "silhouettes",
        .program = &passes.device().raster_program("src/shadow/parts/volume_outlines.vert", "src/shadow/parts/volume_outlines.frag", modes),
        .bindings = {{faces.quads, Use::load}, {frame.gbuffer.depth, Use::sample}},
        .constants = c,
        .colors = {{.image = out, .load = load, .blend = over}},
        .buffers = {{faces.draws, Use::indirect}},
        .draw = [draws = faces.draws](gpu::Encoder& encoder) {
            constexpr uint32_t one = sizeof(VkDrawIndirectCommand);
            encoder.draw_indirect(draws, VOLUME_QUADS * one, 1, one);
        }});
}

} // namespace

void draw_volume_outlines(
    gpu::PassList& passes, const Frame& frame, VolumeCasters& casters, const VolumeSettings& settings, gpu::ImageId out)
{
    casters.update(frame.resources, settings.transmittance);
    VolumeSettings all = settings;
    all.bands = nullptr, all.slot_bands = {};
    VolumeFaces faces(passes, frame, casters, all, false);
    if (frame.counters) frame.counters->push_back({"volume_quads", faces.work, uint32_t(offsetof(shaders::VolumeWork, quads))});
    faces.begin();
    for (uint32_t step = 0; step < faces.steps(); ++step) {
        faces.make(step);
        draw_lines(passes, frame, faces, out, true, step == 0 ? gpu::Load::clear : gpu::Load::keep);
        draw_lines(passes, frame, faces, out, false, gpu::Load::keep);
    }
}

} // namespace gnomon::shadow::parts
