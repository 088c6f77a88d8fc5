// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/light_map.shared.h"
#include "shadow/technique.h"

#include <algorithm>

// The joint on which projections and filters turn: depth layers of one light. A fit is written once and serves every filter; a
// filter is written once, against shaders/light_map.glsl, and runs with every fit and every light.
namespace gnomon::shadow::parts {

/// What the map of a directional light, or of a spot that has one layer, covers: all that it may light, or what the view sees of that (the
/// potential shadow receivers), in one layer, in several one behind another, or warped, so that texels are smaller near the eye
/// (fit_warped.cpp). Cubes cover everything. sdsm: layers about what the depth buffer holds, fitted on the GPU (parts/sdsm.h); without the
/// GPU, as cascades that are not stable.
enum class Fit : int { uniform, focused, cascades, psm, lispsm, tsm, cascades_warped, sdsm };
/// How a warp fades where the light shines along the view (warp_parameter.h).
enum class Falloff : int { lloyd, sine };
/// Of a point light, or a spot wider than 120 degrees: a cube's six layers; a tetrahedron's four, whose texels are 2.4 times as wide; or
/// two paraboloids, which are no projections: straight edges are arcs in them (layer_at in shaders/light_map.glsl reads them).
enum class PointLayout : int { cube, tetrahedron, dual_paraboloid };
enum class DepthFormat : int { d32, d16 };
/// Which casters are drawn: all; those whose bounds touch a layer; of these, under a sun, those between it and a receiver that is seen
/// (parts/cull.h). Pictures are the same.
enum class Culling : int { none, frustum, receivers };

struct LightMapSettings {
    int size = 1024; ///< texels a side, each layer
    shaders::FitParams fitting = {};
    DepthFormat format = DepthFormat::d32;
    float slope_bias = 0.0f; ///< polygon offset factor, applied by the hardware while drawing (factor * max |dz/dx|, |dz/dy|)
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    Culling culling = Culling::frustum;
    float offset_texels = 0.0f; ///< by which receivers are moved across the map at most before they look into it: for Culling::receivers
    float guard_texels = 1.5f; ///< filter radius plus 1: layers are drawn that much wider, so that no filter runs over a rim
};

struct LightMap {
    gpu::ImageId depth; ///< 2D array, reversed depth: 1 nearest the light, 0 = nothing there
    shaders::LightMap constants; ///< for shaders/light_map.glsl
    gpu::BufferId fitted{}; ///< a shaders::FittedMap where the GPU fits the layers: those in `constants` only hold them, and passes that
                            ///< have constants from here take them through with_map or with_layer
};

/// A pass's constants in which `map.constants` lies at `offset`, with what the GPU has fitted in its place.
gpu::Constants with_map(gpu::Constants, const LightMap& map, size_t offset);
/// The same for one layer.
gpu::Constants with_layer(gpu::Constants, const LightMap& map, uint32_t layer, size_t offset);

/// Describes the parameters that every technique with a light map has. `largest`: texels a side, by what else it keeps of a map.
void describe_map(Fields&, int& map_size, shaders::FitParams&, int largest);

/// The same without warps and paraboloids, for those who need texels of one width.
shaders::FitParams unwarped(shaders::FitParams);

/// Which layouts exist for a light: directional -> one orthographic layer, or one for each cascade; spot up to 120 degrees -> one
/// perspective layer; wider spots and points -> six cube faces, the four of a tetrahedron or two paraboloids. Rect and disk lights are
/// taken at their centre, as points, with a cube that stands as they do: the face along +z is parallel to them, and its rows and columns to
/// a rectangle's sides.
shaders::LightMap fit_light_map(const scene::Scene&, const Bounds&, const scene::View&, const scene::Light&, const LightMapSettings&);

/// A filter of `kernel` texels held to what a map can give: a quarter of its side. Wider ones would average unrelated parts of the
/// scene, and the guard around a cube's face would leave nothing of the face.
inline int filter_width(int kernel, int map_size) { return std::clamp(kernel, 1, std::max(map_size / 4, 1)); }

/// Draws all opaque and masked casters into the fitted layers: one pass, culled per layer.
LightMap draw_light_map(gpu::PassList&, const Frame&, const LightMapSettings&);

/// Draws, into an image like `before`, the first surface behind it in each texel: depth peeling (Everitt 2001). Without slope bias, which
/// would move a surface off itself.
gpu::ImageId peel_light_map(gpu::PassList&, const Frame&, const LightMap&, const LightMapSettings&, gpu::ImageId before);

} // namespace gnomon::shadow::parts
