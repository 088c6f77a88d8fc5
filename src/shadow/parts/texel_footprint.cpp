// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/texel_footprint.h"

#include "shadow/light_constants.h"
#include "src/shadow/parts/texel_footprint.shared.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow::parts {

namespace {

using glm::dmat2;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// The derivative by the point of a projective map's first two coordinates.
struct Derivative {
    dvec3 x, y;
    dvec2 along(dvec3 d) const { return {glm::dot(x, d), glm::dot(y, d)}; }
    dvec3 ray() const { return glm::normalize(glm::cross(x, y)); } ///< along which nothing changes
};

Derivative derivative(const dmat4& m, dvec3 p, dvec2 scale)
{
    const dmat4 rows = glm::transpose(m);
    const dvec4 h = m * dvec4(p, 1.0);
    const auto quotient = [&](int i) { return (dvec3(rows[i]) * h.w - dvec3(rows[3]) * h[i]) * scale[i] / (h.w * h.w); };
    return {quotient(0), quotient(1)};
}

dmat2 columns(const Derivative& d, dvec3 a, dvec3 b) { return {d.along(a), d.along(b)}; }

dvec3 across(dvec3 d) { return glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))); }

} // namespace

TexelFootprint texel_footprint(const shaders::LightMapLayer& layer, double size, const scene::View& view, dvec3 p, dvec3 n)
{
    const dvec2 half_size(0.5 * view.size.width, 0.5 * view.size.height);
    const Derivative pixel = derivative(dmat4(view.clip_from_world), p, half_size);
    const Derivative texel = derivative(dmat4(layer.map_from_world), p, dvec2(size));
    dvec3 v = pixel.ray(), l = texel.ray();
    if (glm::dot(dvec3(vec3(layer.depth_plane)), l) > 0.0) l = -l;
    const dvec3 forward(-view.view_from_world[0][2], -view.view_from_world[1][2], -view.view_from_world[2][2]);
    if (glm::dot(forward, v) > 0.0) v = -v;

    TexelFootprint out;
    out.projection = std::abs(glm::dot(n, v)) / std::abs(glm::dot(n, l));
    const dvec3 a = across(n), b = glm::cross(n, a);
    out.total = columns(pixel, a, b) * glm::inverse(columns(texel, a, b));
    const dvec3 normal = glm::cross(v, l);
    const dvec3 common = glm::length(normal) > 1e-9 ? glm::normalize(normal) : across(v);
    out.perspective = columns(pixel, common, glm::cross(v, common)) * glm::inverse(columns(texel, common, glm::cross(l, common)));
    return out;
}

double longer_edge(const dmat2& m) { return std::max(glm::length(m[0]), glm::length(m[1])); }

void draw_texel_footprint(
    gpu::PassList& passes, const GBuffer& gbuffer, const scene::View& view, const shaders::LightMap& map, gpu::ImageId out)
{
    passes.fullscreen({.name = "texel footprint",
        .program = &passes.device().raster_program("shaders/fullscreen.vert", "src/shadow/parts/texel_footprint.frag"),
        .bindings = {{gbuffer.depth, gpu::Use::sample}, {gbuffer.normal, gpu::Use::sample}},
        .constants = shaders::TexelFootprintConstants{view_constants(view, 0), map},
        .colors = {{out}}});
}

} // namespace gnomon::shadow::parts
