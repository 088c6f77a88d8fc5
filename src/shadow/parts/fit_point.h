// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shadow/parts/fit.h"

// Layers that look from a point: the parts of fit_light_map for spots, points and areas.
namespace gnomon::shadow::parts {

/// uv in [0,1] with v down, from clip coordinates with y up.
inline mat4 uv_from_clip() { return glm::translate(mat4(1), vec3(0.5f, 0.5f, 0)) * glm::scale(mat4(1), vec3(0.5f, -0.5f, 1)); }

inline vec4 row(const mat4& m, int r) { return vec4(m[0][r], m[1][r], m[2][r], m[3][r]); }

/// `axes`: the cube's, columns in world space.
void fit_cube(shaders::LightMap&, const Bounds&, vec3 position, const mat3& axes, const LightMapSettings&);

/// All around a light: `fitting.point_layout` in the world's axes.
void fit_point(shaders::LightMap&, const Bounds&, vec3 position, const LightMapSettings&);

/// One layer, not warped, of the cone or, but for Fit::uniform, of what the view sees in it: the returned points.
std::vector<vec3> fit_spot(shaders::LightMap&, const Bounds&, const scene::View&, const scene::SpotLight&, const LightMapSettings&);

} // namespace gnomon::shadow::parts
