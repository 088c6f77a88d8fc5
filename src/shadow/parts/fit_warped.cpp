// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/clip.h"
#include "shadow/parts/fit.h"
#include "shadow/parts/warp_parameter.h"
#include "shadow/parts/warp_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

// Every warp is a homography of the plane in which each ray of the light is one point: a focused layer's map. The light stays what it is,
// and stored depth its own, so that casters before and behind the eye keep their order along each ray; published warps of the space, whose
// light may become a sink behind infinity (Stamminger, Drettakis 2002), need a projection through it (Kozlov 2004, "Perspective shadow
// maps: care and feeding"). Rays for which w <= 0 meet nothing that is seen, and the rasteriser leaves them out.
namespace gnomon::shadow::parts {

namespace {

using namespace warp;

constexpr double greatest_ratio = 1e4; ///< of texels' widths; also the weakest warp: n over the map's extent

/// Which way round the map's axes lie, seen along `axis`: with the other sign casters' fronts would be backs.
double orientation(const Rows& rows, vec3 p, dvec3 axis) { return glm::dot(glm::cross(gradient(rows, 0, p), gradient(rows, 1, p)), axis); }

/// The direction of the light's ray through p.
dvec3 ray_through(const shaders::LightMapLayer& layer, vec3 p)
{
    const Rows rows = rows_of(layer);
    const dvec3 ray = glm::cross(gradient(rows, 0, p), gradient(rows, 1, p)), axis(layer.depth_plane);
    return glm::normalize(glm::dot(ray, axis) < 0.0 ? -ray : ray);
}

/// Least and greatest coordinates of the receivers.
struct Rectangle {
    dvec2 min{1e300}, max{-1e300};
};

Rectangle rectangle_of(const Rows& rows, const std::vector<vec3>& points)
{
    Rectangle r;
    for (const vec3 p : points) {
        const dvec3 h = at(rows, p);
        r.min = glm::min(r.min, dvec2(h) / h.z), r.max = glm::max(r.max, dvec2(h) / h.z);
    }
    return r;
}

/// The same map with w >= 1 at all points and axes as `focused` has them; false where there is none.
bool make_valid(Rows& rows, const shaders::LightMapLayer& focused, const std::vector<vec3>& points)
{
    const Rows plain = rows_of(focused);
    double least = 1e300, most = 0.0, least_w = 1e300;
    if (at(rows, points.front()).z < 0.0)
        for (dvec4& r : rows) r = -r;
    for (const vec3 p : points) {
        const double w = at(rows, p).z, growth = w / at(plain, p).z; // of texels, beyond what they grow without the warp
        if (!std::isfinite(w) || !(growth > 0.0)) return false;
        least = std::min(least, growth), most = std::max(most, growth), least_w = std::min(least_w, w);
    }
    if (most > greatest_ratio * least) return false;
    for (dvec4& r : rows) r /= least_w;
    const dvec3 axis(focused.depth_plane);
    const double before = orientation(plain, points.front(), axis), after = orientation(rows, points.front(), axis);
    if (!(before * after != 0.0)) return false;
    if (before * after < 0.0) rows[0] = -rows[0];
    return true;
}

/// The layer that maps the receivers' rectangle to all of the map but its rim (the light frustum fitted to what is seen: Brabec, Annen,
/// Seidel 2002, "Practical shadow mapping").
std::optional<shaders::LightMapLayer> fit_rectangle(
    Rows rows, const shaders::LightMapLayer& focused, const std::vector<vec3>& points, const LightMapSettings& settings)
{
    if (!make_valid(rows, focused, points)) return {};
    const Rectangle r = rectangle_of(rows, points);
    const dvec2 extent = r.max - r.min;
    // a rectangle thinner than that is the seen edge of something flat, and rounding
    if (!(std::min(extent.x, extent.y) > 1e-5 * std::max(extent.x, extent.y))) return {};
    const double inner = 1.0 / double(rim_factor(settings));
    for (int k = 0; k < 2; ++k) {
        const double scale = inner / extent[k], offset = 0.5 - scale * 0.5 * (r.min[k] + r.max[k]);
        rows[size_t(k)] = rows[size_t(k)] * scale + rows[2] * offset;
    }
    shaders::LightMapLayer layer = focused;
    layer.warped = 1;
    const std::array<dvec4, 4> all{rows[0], rows[1], 0.5 * rows[2], rows[2]};
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c) {
            layer.map_from_world[c][i] = float(all[size_t(i)][c]);
            if (!std::isfinite(layer.map_from_world[c][i])) return {};
        }
    double texel = 1e300;
    for (const vec3 p : points) {
        const double unit = layer.perspective != 0 ? glm::dot(dvec4(layer.depth_plane), dvec4(dvec3(p), 1.0)) : 1.0;
        for (int k = 0; k < 2; ++k)
            texel = std::min(texel, 1.0 / (glm::length(across(gradient(rows, k, p), dvec3(layer.depth_plane))) * unit));
    }
    layer.texel_metres = float(texel * double(layer.texel_uv));
    if (!std::isfinite(layer.texel_metres) || layer.texel_metres <= 0.0f) return {};
    return layer;
}

/// The focused map with its second axis along the view's image, and the first from the eye's: of the view's axis between the eye and its
/// furthest receiver, the part before the light. False where that is a point.
bool turn(Rows& rows, const shaders::LightMapLayer& focused, const scene::View& view, const std::vector<vec3>& points)
{
    const Rows plain = rows_of(focused);
    double furthest = 0.0, least_w = 1e300;
    for (const vec3 p : points) furthest = std::max(furthest, depth_in(view, p)), least_w = std::min(least_w, at(plain, p).z);
    dvec3 from = at(plain, view.eye), to = at(plain, view.eye + forward_of(view) * float(furthest));
    if (from.z < least_w && to.z < least_w) return false;
    const dvec3 step = to - from;
    if (from.z < least_w) from += step * ((least_w - from.z) / step.z);
    if (to.z < least_w) to = from + step * ((least_w - from.z) / step.z);
    const dvec2 eye = dvec2(from) / from.z, along = dvec2(to) / to.z - eye;
    if (!(glm::length(along) > 1e-6)) return false;
    // within a degree of a parallel light the image's direction is chance, and the warp for nothing
    if (focused.perspective == 0 && glm::length(glm::cross(dvec3(focused.depth_plane), dvec3(forward_of(view)))) < 0.02) return false;
    const dvec2 t = glm::normalize(along), s(t.y, -t.x);
    const double s0 = glm::dot(s, eye), t0 = glm::dot(t, eye);
    rows = {s.x * plain[0] + s.y * plain[1] - s0 * plain[2], t.x * plain[0] + t.y * plain[1] - t0 * plain[2], plain[2]};
    return true;
}

/// Half the view's angle in the plane of its axis and a ray: how far the ray is from the axis when a side turns edge-on to it.
double half_fov_towards(const scene::View& view, dvec3 ray)
{
    const dvec3 l = glm::dmat3(glm::dmat4(view.view_from_world)) * ray;
    const double sideways = std::hypot(l.x, l.y);
    if (!(sideways > 0.0)) return std::atan(1.0 / std::abs(double(view.clip_from_view[1][1])));
    return std::atan(
        sideways / std::max(std::abs(l.x * double(view.clip_from_view[0][0])), std::abs(l.y * double(view.clip_from_view[1][1]))));
}

/// n of lispsm or tsm for a turned map whose receivers lie between t = `first` and first + `extent`. The line along which errors are
/// levelled (Eisemann, Schwarz, Assarsson, Wimmer 2011, "Real-Time Shadows", 4.2.2) starts as deep as the nearest receiver, and stays as
/// far from the light.
double warp_distance(const Rows& turned, const shaders::LightMapLayer& focused, const scene::View& view, const std::vector<vec3>& points,
    double extent, const LightMapSettings& settings)
{
    const vec3* nearest = &points.front();
    double deepest = 0.0;
    for (const vec3& p : points) {
        if (depth_in(view, p) < depth_in(view, *nearest)) nearest = &p;
        deepest = std::max(deepest, depth_in(view, p));
    }
    const double z0 = std::max(depth_in(view, *nearest), double(view.near));
    const dvec3 axis(focused.depth_plane), forward(forward_of(view));
    const dvec3 along = across(gradient(turned, 1, *nearest), axis); // metres of the world that t takes: its inverse
    const double z1 = z0 + extent * glm::dot(forward, along) / glm::dot(along, along);
    if (!(z1 > z0)) return std::numeric_limits<double>::infinity();
    // Differs from the paper: the user's focus distance is the geometric mean of the depths, where half of their ratio lies.
    if (Fit(settings.fitting.fit) == Fit::tsm) return trapezoid_near((std::sqrt(z0 * z1) - z0) / (z1 - z0) * extent, extent, 0.8);
    const WarpLine line{z0, z1, extent, z0 + double(settings.fitting.warp_near) * (deepest - z0), z1};
    if (Falloff(settings.fitting.warp) == Falloff::sine) return pseudo_near(line.z0, line.z1, line.extent, line.from, line.to);
    Bounds hull;
    for (const vec3 p : points) hull.add(p);
    const dvec3 ray = ray_through(focused, hull.centre());
    return warp_near(line, std::acos(std::clamp(glm::dot(ray, forward), -1.0, 1.0)), half_fov_towards(view, ray));
}

/// Across the light: a frustum whose axis is the view's image and whose near plane lies n before the first receiver (Wimmer, Scherzer,
/// Purgathofer 2004, "Light space perspective shadow maps"; trapezoids of Martin and Tan 2004 are such frusta).
std::optional<Rows> frustum_across(
    const shaders::LightMapLayer& focused, const scene::View& view, const std::vector<vec3>& points, const LightMapSettings& settings)
{
    Rows rows;
    if (!turn(rows, focused, view, points)) return {};
    const Rectangle r = rectangle_of(rows, points);
    const double extent = r.max.y - r.min.y, n = warp_distance(rows, focused, view, points, extent, settings);
    if (!(n > 0.0) || n > greatest_ratio * extent) return {};
    // x' = s / w, y' = -1 / w (rises with t), w = t - (t of the first receiver) + n
    const dvec4 w = rows[1] + (n - r.min.y) * rows[2];
    return Rows{rows[0], -rows[2], w};
}

/// The storage factor, but for a factor: the widest texels over the widths of pixels at their depth, in u times in v (Lloyd 2007), at the
/// corners of what is seen. The falloff knows nothing of what turning the map to the view's image costs.
double storage_factor(const shaders::LightMapLayer& layer, const scene::View& view, const std::vector<vec3>& points)
{
    const Rows rows = rows_of(layer);
    dvec2 largest(0.0);
    for (const vec3 p : points)
        for (int k = 0; k < 2; ++k) {
            const double wide = 1.0 / glm::length(across(gradient(rows, k, p), dvec3(layer.depth_plane)));
            largest[k] = std::max(largest[k], wide / std::max(depth_in(view, p), double(view.near)));
        }
    return largest.x * largest.y;
}

} // namespace

std::optional<shaders::LightMapLayer> warped_layer(
    const shaders::LightMapLayer& focused, const scene::View& view, const std::vector<vec3>& receivers, const LightMapSettings& settings)
{
    if (receivers.empty() || view.orthographic) return {};
    std::optional<Rows> rows;
    if (Fit(settings.fitting.fit) == Fit::psm) {
        rows = view_of_cube(focused, view, receivers, double(settings.fitting.psm_slide));
    } else {
        rows = frustum_across(focused, view, receivers, settings);
    }
    std::optional<shaders::LightMapLayer> layer;
    if (rows) layer = fit_rectangle(*rows, focused, receivers, settings);
    const bool held = Fit(settings.fitting.fit) != Fit::psm && Fit(settings.fitting.fit) != Fit::tsm
        && Falloff(settings.fitting.warp) == Falloff::lloyd;
    if (layer && held && storage_factor(*layer, view, receivers) > storage_factor(focused, view, receivers)) return {};
    return layer;
}

} // namespace gnomon::shadow::parts
