// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"

#include <vector>

namespace gnomon::techniques::light_sampling {

enum class Pattern : int { jittered, hammersley };

struct LightPoints {
    std::vector<vec4> points; ///< in the form of scene::light_point
    std::vector<vec4> weights; ///< what each emits, relative to the mean of all in each channel; rgb of a light with an image, else 1
};

/// `n` points that stand for the light whoever looks, each for an n-th of its area. One point, and any number for a light without size, is
/// its centre. `seen_from`: whence the points of a sphere are spread best.
LightPoints light_points(const scene::Light&, int n, Pattern, vec3 seen_from);

} // namespace gnomon::techniques::light_sampling
