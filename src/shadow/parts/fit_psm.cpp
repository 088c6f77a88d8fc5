// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/warp_rows.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts::warp {

namespace {

/// The unit vector about which a cone holds all `directions` with the least angle: the centre of the smallest ball around them, walked to
/// (Badoiu, Clarkson 2003, "Smaller core-sets for balls"). Zero where a half-space does not hold them.
dvec3 cone_axis(const std::vector<dvec3>& directions)
{
    dvec3 centre = directions.front();
    for (int step = 1; step <= 400; ++step) {
        const auto furthest = std::max_element(
            directions.begin(), directions.end(), [&](dvec3 a, dvec3 b) { return glm::distance(a, centre) < glm::distance(b, centre); });
        centre += (*furthest - centre) / double(step + 1);
    }
    if (!(glm::length(centre) > 1e-6)) return dvec3(0);
    centre = glm::normalize(centre);
    for (const dvec3 d : directions)
        if (glm::dot(d, centre) < 1e-3) return dvec3(0);
    return centre;
}

/// The view's projection from `slide` metres behind the eye, onto the cube [-1, 1]^3 between the depths of the receivers, as wide as they
/// are (Kozlov 2004: the near plane as far as what is seen allows, and the eye moved back, for texels less unlike).
dmat4 to_cube(const scene::View& view, const std::vector<vec3>& points, double slide)
{
    const dmat4 view_from_world(view.view_from_world);
    double near = 1e300, far = 0.0;
    dvec2 widest(1e-12);
    for (const vec3 p : points) {
        const dvec3 q(view_from_world * dvec4(dvec3(p), 1.0));
        const double depth = std::max(-q.z, double(view.near)) + slide;
        near = std::min(near, depth), far = std::max(far, depth);
        widest = glm::max(widest, glm::abs(dvec2(q)) / depth);
    }
    far = std::max(far, near * 1.000001);
    dmat4 cube(0.0); // of (x, y, z) with depth = slide - z
    cube[0][0] = 1.0 / widest.x, cube[1][1] = 1.0 / widest.y;
    cube[2][2] = -(far + near) / (far - near), cube[3][2] = (slide * (far + near) - 2.0 * far * near) / (far - near);
    cube[2][3] = -1.0, cube[3][3] = slide;
    return cube * view_from_world;
}

/// Where the rays of a perspective layer meet.
vec3 apex(const shaders::LightMapLayer& layer)
{
    const Rows r = rows_of(layer);
    const glm::dmat3 m = glm::transpose(glm::dmat3(dvec3(r[0]), dvec3(r[1]), dvec3(r[2])));
    return vec3(-(glm::inverse(m) * dvec3(r[0].w, r[1].w, r[2].w)));
}

} // namespace

std::optional<Rows> view_of_cube(
    const shaders::LightMapLayer& focused, const scene::View& view, const std::vector<vec3>& points, double slide)
{
    double deepest = 0.0;
    for (const vec3 p : points) deepest = std::max(deepest, depth_in(view, p));
    const dmat4 cube = to_cube(view, points, slide * deepest);
    const dvec4 light = cube * (focused.perspective != 0 ? dvec4(dvec3(apex(focused)), 1.0) : dvec4(dvec3(focused.depth_plane), 0.0));
    const double out = glm::length(dvec3(light));
    dvec3 axis, eye(0.0);
    // Further than a hundred cubes away all cones are the same, and w = 0, a light across the view, is nothing special.
    const bool distant = std::abs(light.w) * 100.0 < out;
    if (distant) {
        axis = dvec3(light) * ((light.w < 0.0 ? 1.0 : -1.0) / out);
    } else {
        eye = dvec3(light) / light.w;
        std::vector<dvec3> directions;
        for (const vec3 p : points) {
            const dvec4 q = cube * dvec4(dvec3(p), 1.0);
            directions.push_back(glm::normalize(dvec3(q) / q.w - eye));
        }
        axis = cone_axis(directions);
        if (axis == dvec3(0)) return {}; // the light is among them
    }
    const dvec3 up = std::abs(axis.z) < 0.99 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    const dvec3 x = glm::normalize(glm::cross(up, axis)), y = glm::cross(axis, x);
    const auto seen_along = [&](dvec3 v) { return dvec4(v, -glm::dot(v, eye)) * cube; };
    if (distant) return Rows{seen_along(x), seen_along(y), dvec4(axis * (std::abs(light.w) / out), 1.0) * cube};
    return Rows{seen_along(x), seen_along(y), seen_along(axis)};
}

} // namespace gnomon::shadow::parts::warp
