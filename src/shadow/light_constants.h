// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light.h"
#include "scene/view.h"
#include "shaders/frame.shared.h"

namespace gnomon::shadow {

/// The blocks that most passes begin with.
shaders::View view_constants(const scene::View&, uint32_t frame_index);
shaders::Light light_constants(const scene::Light&, const Bounds& scene_bounds);

/// Light::intensity, or the one that alone gives irradiance pi at the centre of `bounds` (at normal incidence).
float effective_intensity(const scene::Light&, const Bounds&);

} // namespace gnomon::shadow
