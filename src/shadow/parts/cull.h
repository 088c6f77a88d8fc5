// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/light_map.h"

// Casters that change no visible pixel are not drawn (Bittner, Mattausch, Silvennoinen, Wimmer 2011, "Shadow caster culling for efficient
// shadow mapping"). Their mask of receivers is drawn as a stencil and tested by occlusion queries; here the G-buffer's pixels mark it, and
// a compute pass writes draw commands: the GPU waits for no answer.
namespace gnomon::shadow::parts {

/// The commands of SceneGpu::draw_indirect for each layer in turn, of a parallel light's map (orthographic layers). A caster is drawn where
/// its bounds touch the layer, or, with Culling::receivers, where they lie between the light and a receiver that is seen, faces the light
/// and reads no further than `reach` texels from its place.
gpu::BufferId cull_casters(gpu::PassList&, const Frame&, const LightMap&, Culling, float reach);

} // namespace gnomon::shadow::parts
