// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/view.h"

namespace gnomon::scene {

/// A rectangle of a picture's pixels.
struct Crop {
    int left = 0, top = 0;
    Size size;
};

/// A view of a part alone of the picture of `size`: same eye, same rays, an off-centre frustum. Null: of all of it.
View make_view(const Camera&, Size size, const Bounds& scene_bounds, vec2 jitter, const Crop*);

} // namespace gnomon::scene
