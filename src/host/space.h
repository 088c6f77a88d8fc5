// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/view.h"

#include <gnomon/gnomon.h>

#include <glm/gtc/type_precision.hpp>

// From the host's conventions to Gnomon's: metres, +Y up, right-handed, reversed depth (docs/conventions.md).
namespace gnomon::host {

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;

/// `origin`, in host units, becomes Gnomon's: far from the host's own, floats would have no digits left for shadows.
dmat4 world_from_host(const gnomon_space&, const dvec3& origin);

dmat4 matrix_of(const VkTransformMatrixKHR&); ///< rows of 3x4 as a matrix

/// A view of Gnomon's that sees what the host's matrices see, and how to find it in the host's depth image.
struct HostView {
    scene::View view;
    dmat4 world_from_clip; ///< Gnomon's world from the host's clip space, image row 0 at y = -1
    dvec4 depth_row, w_row; ///< view depth = dot(depth_row, p) / dot(w_row, p), of the host's p = (x, y, depth - background, 1)
};
/// `bounds`: of what is seen, Gnomon's world. Throws Refusal where the matrices are singular or not finite.
HostView view_of(const gnomon_frame&, const dmat4& world_from_host, base::Size, const Bounds&);

/// Throws Refusal naming the number that is wrong.
scene::Light light_of(const gnomon_light&, const dmat4& world_from_host);

} // namespace gnomon::host
