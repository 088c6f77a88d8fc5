// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lab/render.h"
#include "truth/truth.h"

#include <array>
#include <optional>
#include <vector>

// A plane through a scene with the shadow value at each of its points, as if a receiver that faces the light stood there. It shows what
// a technique believes about the space between occluders and receivers, which a picture from the eye shows only where a surface is.
namespace gnomon::lab {

struct SliceOptions {
    std::optional<vec3> centre; ///< the scene's centre where left out
    std::optional<vec3> right, up; ///< directions; left out: the vertical plane that holds the light's direction at the centre
    float height = 0; ///< metres shown; 0 = so that the scene fits
};

struct Slice {
    vec3 centre, right, up; ///< the centre is counted from Stage::origin; the axes are unit vectors
    scene::View view; ///< orthographic, straight at the plane
    float depth; ///< of the plane in this view
};

/// For the stage's first light and size. Throws base::Error where the axes have no plane between them.
Slice make_slice(const Stage&, const SliceOptions&);

/// The technique's image of the slice. Throws base::Error where it refuses device or light.
base::Picture slice_image(gpu::Device&, shadow::SceneGpu&, const Stage&, const Slice&, const Choice&);
/// The ray-traced twin.
base::Picture slice_truth(const Stage&, const Slice&, truth::Quantity, int samples);

/// Where the plane cuts triangles that block light, in pixels.
std::vector<std::array<vec2, 2>> slice_outline(const scene::Scene&, const Slice&);
/// The image with the outline, to look at.
base::Picture slice_display(const base::Picture& image, const std::vector<std::array<vec2, 2>>& outline);

} // namespace gnomon::lab
