// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

// The colour spaces of FLIP (flip.cpp), with sRGB primaries and D65 white.
namespace gnomon::metrics {

using Color = std::array<float, 3>;

/// YCxCz: an opponent space (luminance, red-green, blue-yellow) that is linear, so that filtering in it is filtering of light.
Color ycxcz(const Color& linear_rgb);
Color rgb_from_ycxcz(const Color&);

/// CIELab with the Hunt effect: colourfulness grows with lightness.
Color hunt_lab(const Color& linear_rgb);

/// HyAB distance: city block between lightness and chromaticity, Euclidean within the latter.
double hyab(const Color&, const Color&);

} // namespace gnomon::metrics
