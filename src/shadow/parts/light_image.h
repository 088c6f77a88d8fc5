// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/light_image.h"

#include <vector>

// The image of a rectangular light for methods that know which part of the light is hidden. Lookups: shaders/light_image.glsl and
// light_samples.glsl.
namespace gnomon::shadow::parts {

/// The size in texels and the number of the first sample's entry; then for each corner of a texel, from centre - half_u - half_v on and
/// along half_u first, what the light emits in the rectangle between there and that corner: red, green and blue, each 1 for the whole
/// light; then what each sample (shadow/parts/light_samples.h) emits, of a sum of 1. In a channel in which no sample lies on a texel that
/// emits, they count alike.
std::vector<vec4> light_image_table(const scene::LightImage&, const std::vector<glm::ivec2>& sample_cells);

} // namespace gnomon::shadow::parts
