// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"

#include <vector>

namespace gnomon::techniques::light_sampling {

enum class Pattern : int { jittered, hammersley };

/// `n` points that stand for the light whoever looks, each for an n-th of it, in the form of scene::light_point. One point, and any number
/// for a light without size, is its centre. `seen_from`: whence the points of a sphere are spread best.
std::vector<vec4> light_points(const scene::Light&, int n, Pattern, vec3 seen_from);

} // namespace gnomon::techniques::light_sampling
