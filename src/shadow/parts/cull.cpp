// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/cull.h"

#include "shadow/light_constants.h"
#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/cull.shared.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::shadow::parts {

gpu::BufferId cull_casters(gpu::PassList& passes, const Frame& frame, const LightMap& map, Culling culling, float reach)
{
    const uint32_t layers = map.constants.layer_count, casters = frame.resources.slot_count();
    const bool masked = culling == Culling::receivers;
    const uint64_t texels = masked ? uint64_t(layers) * CULL_MASK_SIZE * CULL_MASK_SIZE : 1; // else it is bound, and not read
    const gpu::BufferId mask = passes.transient({texels * sizeof(uint32_t), 0, gpu::Memory::device, "receiver mask"});
    const gpu::BufferId commands = passes.transient({std::max<uint64_t>(uint64_t(layers) * casters, 1) * sizeof(shaders::DrawCommand),
        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, gpu::Memory::device, "caster commands"});
    const gpu::Constants constants = with_map(shaders::CullConstants{view_constants(frame.view, frame.index),
                                                  light_constants(frame.light, frame.resources.bounds()), map.constants, reach, casters},
        map, offsetof(shaders::CullConstants, map));
    passes.fill(mask, 0, "mask clear");
    if (masked)
        passes.compute({.name = "receiver mask",
            .program = &passes.device().compute_program("src/shadow/parts/cull_mask.comp"),
            .bindings = {{frame.gbuffer.depth, gpu::Use::sample}, {frame.gbuffer.normal, gpu::Use::sample}, {mask, gpu::Use::update}},
            .constants = constants,
            .threads = {uint32_t(frame.view.size.width), uint32_t(frame.view.size.height), 1}});
    const gpu::SpecConstant spec[] = {{0, uint32_t(masked)}};
    passes.compute({.name = "cull casters",
        .program = &passes.device().compute_program("src/shadow/parts/cull_casters.comp", spec),
        .bindings = {{passes.import(frame.resources.casters()), gpu::Use::load}, {mask, gpu::Use::load}, {commands, gpu::Use::store}},
        .constants = constants,
        .threads = {casters, layers, 1}});
    return commands;
}

} // namespace gnomon::shadow::parts
