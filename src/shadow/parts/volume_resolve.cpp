// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volumes.h"

namespace gnomon::shadow::parts {

using gpu::Use;

void resolve_volumes(gpu::PassList& passes, const Frame& frame, const VolumeSettings& settings, const VolumeCounts& counts)
{
    gpu::FullscreenPass pass{.name = "resolve", .bindings = {{counts.receivers, Use::sample}}, .colors = {{frame.output}}};
    gpu::Binding counted{counts.counts, Use::sample};
    if (counts.stencil) {
        counted.aspect = VK_IMAGE_ASPECT_STENCIL_BIT;
        pass.program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_resolve_stencil.frag");
        pass.bindings.push_back(counted);
    } else {
        const gpu::SpecConstant modes[] = {{0, settings.transmittance ? 1u : 0u}};
        pass.program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/volume_resolve.frag", modes);
        pass.bindings.insert(pass.bindings.end(), {counted, {counts.eye, Use::load}});
    }
    passes.fullscreen(std::move(pass));
}

} // namespace gnomon::shadow::parts
