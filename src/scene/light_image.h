// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::scene {

/// The longest side that is kept; larger pictures are averaged down.
inline constexpr int light_image_side = 64;

/// What a rectangular light emits over its area: constant in each texel, the picture that is seen upright by someone who stands before the
/// light with half_v up, so that half_u is on the right. Texel (0, 0) lies at the corner centre - half_u + half_v.
struct LightImage {
    int width = 0, height = 0; ///< texels; 0 = uniform
    /// Row 0 on top. Each channel relative to its own mean: the mean is 1. A channel in which the light emits nothing is 1 everywhere, so
    /// that its visibility is the fraction of the area, the limit of an ever fainter uniform glow.
    std::vector<vec3> texels;
    vec3 tint{1}; ///< mean colour, its three channels' mean 1: multiplies Light::color, so that intensity keeps its meaning

    bool empty() const { return texels.empty(); }
    /// At `u` of light_point.
    vec3 at(vec2 u) const;
};

/// From what is emitted, row 0 on top. Throws Error, which names it `name`, where a value is negative or not finite or all are 0.
LightImage make_light_image(int width, int height, const std::vector<vec3>& emitted, const std::string& name);

/// A built-in image ("halves", "window", "glow"; "none" = uniform), else a file: .png or .jpg as sRGB, .exr as linear; alpha is left out of
/// account. `folder` is where relative names begin. Throws Error.
LightImage load_light_image(const std::string& name_or_file, const std::filesystem::path& folder = {});

} // namespace gnomon::scene
