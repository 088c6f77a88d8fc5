// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/math.h"
#include "scene/view.h"
#include "shadow/scene_gpu.h"

#include <vector>

namespace gnomon::shadow::parts {

/// The vertices of (what the view sees) ∩ (the box), world space: faces of the box clipped by the frustum's planes and faces of
/// the frustum, cut off beyond the box, clipped by the box. Empty where the view sees nothing of it.
std::vector<vec3> visible_part(const scene::View&, const Bounds& box);

/// The same between two distances from the eye along the view's axis.
std::vector<vec3> visible_part(const scene::View&, const Bounds& box, float from, float to);

/// The same, of what a spot lights from `near` metres on along its axis.
std::vector<vec3> visible_part(const scene::View&, const Bounds& box, const scene::SpotLight&, float near);

/// The axis along which a view looks, unit.
vec3 forward_of(const scene::View&);

/// The vertices of the part of the box, widened by a ten-thousandth, that is inside of all planes. Empty where there is none.
std::vector<vec3> vertices_within(const Planes&, const Bounds& box);

} // namespace gnomon::shadow::parts
