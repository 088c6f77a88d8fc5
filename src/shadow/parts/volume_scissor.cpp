// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/volumes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::shadow::parts {

namespace {

using glm::dvec3;
using glm::dvec4;

/// A pyramid around the cone, from its tip to beyond the scene: triangles that cover it as seen from anywhere.
std::vector<std::array<dvec3, 3>> pyramid_about(const scene::SpotLight& spot, const Bounds& scene)
{
    constexpr int corners = 12;
    const double reach = double(glm::length(scene.centre() - spot.position)) + double(scene.radius());
    // the polygon holds the circle, which as a section by a plane reaches as far as the scene
    const double radius = reach * std::tan(double(spot.outer_angle) + 1e-3) / std::cos(glm::pi<double>() / corners);
    const glm::dmat3 basis(scene::basis_about(spot.direction));
    const dvec3 tip(spot.position), end = tip + reach * dvec3(spot.direction);
    std::vector<std::array<dvec3, 3>> out;
    for (int i = 0; i < corners; ++i) {
        const auto corner = [&](int k) {
            const double angle = 2 * glm::pi<double>() * k / corners;
            return end + radius * (std::cos(angle) * basis[0] + std::sin(angle) * basis[1]);
        };
        out.push_back({tip, corner(i), corner(i + 1)});
        out.push_back({end, corner(i), corner(i + 1)});
    }
    return out;
}

} // namespace

PixelRectangle lit_rectangle(const scene::View& view, const scene::Light& light, const Bounds& scene)
{
    const double width = view.size.width, height = view.size.height;
    PixelRectangle all{0, 0, uint32_t(view.size.width), uint32_t(view.size.height)};
    const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
    if (!spot || spot->outer_angle > 1.4f || scene.empty()) return all;
    glm::dvec2 least(1e300), most(-1e300);
    for (const auto& triangle : pyramid_about(*spot, scene)) {
        dvec4 clip[3];
        for (size_t k = 0; k < 3; ++k) clip[k] = glm::dmat4(view.clip_from_world) * dvec4(triangle[k], 1);
        for (size_t k = 0; k < 3; ++k) {
            // what lies before the near plane is not seen, so that sides that reach beyond it end there: at depth 1, z = w
            const dvec4 a = clip[k], b = clip[(k + 1) % 3];
            const double from = a.w - a.z, to = b.w - b.z;
            const auto add = [&](const dvec4& p) {
                const glm::dvec2 at = (glm::dvec2(p) / p.w * 0.5 + 0.5) * glm::dvec2(width, height);
                least = glm::min(least, at), most = glm::max(most, at);
            };
            if (from >= 0 && a.w > 0) add(a);
            if ((from >= 0) != (to >= 0)) add(a + (b - a) * (from / (from - to)));
        }
    }
    if (least.x > most.x) return {0, 0, 0, 0};
    // a pixel more than its centres need
    least = glm::clamp(glm::floor(least) - 1.0, glm::dvec2(0), glm::dvec2(width, height));
    most = glm::clamp(glm::ceil(most) + 1.0, glm::dvec2(0), glm::dvec2(width, height));
    return {int(least.x), int(least.y), uint32_t(most.x - least.x), uint32_t(most.y - least.y)};
}

} // namespace gnomon::shadow::parts
