// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/pass_list.h"
#include "scene/view.h"

namespace gnomon::shadow {

class SceneGpu;

/// The receiver as drawn from the eye. Read it in GLSL through shaders/receiver.glsl.
struct GBuffer {
    gpu::ImageId depth; ///< D32F, reversed: 1 at the near plane, 0 = background
    gpu::ImageId normal; ///< RG32UI: snorm16x2 octahedral shading normal (x) and geometric normal (y), world, both on the eye's side
    gpu::ImageId primitive; ///< R32UI: scene-wide primitive id, 0xffffffff = background
    gpu::ImageId albedo; ///< RGBA8 sRGB: base colour
    gpu::ImageId surface; ///< RGBA8: metallic, roughness, 0, 0
    gpu::ImageId emissive; ///< RGBA16F; invalid where no material of the scene emits
    gpu::ImageId motion; ///< RG32F: uv now - uv in the previous frame; invalid unless asked for
};

/// What beyond the receiver itself is wanted.
struct GBufferRequest {
    bool material = true; ///< albedo, surface, emissive
    const scene::View* previous = nullptr; ///< writes `motion`
    bool flat = false; ///< the scene has no normals on the device: shading normals are the geometric ones
};

/// Draws opaque and masked triangles (blended ones are drawn after lighting): one raster pass, "gbuffer".
GBuffer draw_gbuffer(gpu::PassList&, SceneGpu&, const scene::View&, const GBufferRequest& = {});

} // namespace gnomon::shadow
