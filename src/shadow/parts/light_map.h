// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/light_map.shared.h"
#include "shadow/technique.h"

// The joint on which projections and filters turn: depth layers of one light. A fit is written once and serves every filter; a
// filter is written once, against shaders/light_map.glsl, and runs with every fit and every light.
namespace gnomon::shadow::parts {

enum class Fit : int { scene, view }; ///< directional: the map covers the scene, or what the view sees of it
enum class DepthFormat : int { d32, d16 };

struct LightMapSettings {
    int size = 1024; ///< texels a side, each layer
    Fit fit = Fit::view;
    DepthFormat format = DepthFormat::d32;
    float slope_bias = 0.0f; ///< polygon offset factor, applied by the hardware while drawing (factor * max |dz/dx|, |dz/dy|)
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    float guard_texels = 1.5f; ///< filter radius that must not run over a cube face's rim: faces are drawn that much wider
};

struct LightMap {
    gpu::ImageId depth; ///< 2D array, reversed depth: 1 nearest the light, 0 = nothing there
    shaders::LightMap constants; ///< for shaders/light_map.glsl
};

/// Which layouts exist for a light: directional -> one orthographic layer; spot up to 120 degrees -> one perspective layer; wider
/// spots and points -> six cube faces. Rect and disk lights are taken at their centre, as points.
shaders::LightMap fit_light_map(const scene::Scene&, const Bounds&, const scene::View&, const scene::Light&, const LightMapSettings&);

/// Draws all opaque and masked casters into the fitted layers: one pass, culled per layer.
LightMap draw_light_map(gpu::PassList&, const Frame&, const LightMapSettings&);

} // namespace gnomon::shadow::parts
