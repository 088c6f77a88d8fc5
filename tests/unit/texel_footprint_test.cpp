// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/texel_footprint.h"

#include "scene/light.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/sampling_error.h"
#include "tests/light_map_twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gnomon::shadow::parts {
namespace {

using glm::dmat2;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// Along +z from the origin, near 1, half a field of view of 30 degrees; the box ends at 100 and holds the frustum.
const Bounds box{{-400, -400, -20}, {400, 400, 100}};
constexpr base::Size picture{640, 360};
constexpr int map_size = 512;
constexpr double half_fov = 3.14159265358979323846 / 6.0;
const Frustum frustum{1.0, 100.0, half_fov, 640.0 / 360.0};

scene::View along_z() { return scene::make_view({"", {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, float(2.0 * half_fov), 0, 1.0f}, picture, box); }

shaders::LightMap fitted(const scene::View& view, const char* light, FitSettingsOf settings);

/// A texel's edges in pixels, t's (along the picture's height) and s's, in the book's sense: components, for maps with as many texels as
/// the picture has pixels.
Error components(const dmat2& m)
{
    const bool t_first = std::abs(m[0].y) > std::abs(m[1].y);
    const dvec2 t = t_first ? m[0] : m[1], s = t_first ? m[1] : m[0];
    return {std::abs(t.y) * map_size / picture.height, std::abs(s.x) * map_size / picture.width};
}

} // namespace
} // namespace gnomon::shadow::parts
