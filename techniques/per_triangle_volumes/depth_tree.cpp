// SPDX-License-Identifier: Apache-2.0
#include "techniques/per_triangle_volumes/depth_tree.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace gnomon::techniques::per_triangle_volumes {

namespace {

/// A few units in the last place of a depth, and of coordinates far from the origin. At 5e-6 the leaves of `tree` showed it at their edges:
/// twice as many pixels were wrong.
constexpr float rounding = 2e-6f;

/// By which depth grows when a point moves towards the eye by `rounding` of its distance and of its coordinates, as a polynomial in it: of
/// 1 / w = depth / near in a perspective view, where dw = -rounding (w + offset), and of a distance in an orthographic one.
vec3 nearer(const scene::View& view)
{
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(view.clip_from_world));
    const float offset = std::max({std::abs(view.eye.x), std::abs(view.eye.y), std::abs(view.eye.z)});
    if (!view.orthographic) return rounding * vec3(0, 1, offset / view.near);
    const float extent = float(glm::length(glm::dvec3(inverse[2])));
    return {rounding * (1 + offset / extent), 0, 0};
}

} // namespace

shaders::Tree make_tree(const scene::View& view, uvec2 samples_a_pixel)
{
    shaders::Tree tree{};
    tree.samples = uvec2(view.size.width, view.size.height) * samples_a_pixel;
    tree.spread = uvec2(glm::findMSB(samples_a_pixel.x), glm::findMSB(samples_a_pixel.y));
    // A depth carried on by slopes has the roundings of three.
    tree.nearer = (tree.spread == uvec2(0) ? 1.0f : 3.0f) * nearer(view);
    tree.step = 1.0f / vec2(tree.samples);
    const auto nodes = [&](uint32_t height) { return ((tree.samples - 1u) >> shaders::tree_shift(height)) + 1u; };
    for (uint32_t height = 1;; ++height) {
        if (height > TREE_MAX_HEIGHT)
            base::fail("per_triangle_volumes takes pictures of up to 262144 x 131072 samples, not {} x {}; choose a smaller --size",
                tree.samples.x, tree.samples.y);
        tree.height = height;
        tree.first[height] = tree.nodes;
        tree.width[height] = nodes(height).x;
        tree.nodes += nodes(height).x * nodes(height).y;
        if (nodes(height) == uvec2(1) && height >= 3) break; // traverse.glsl begins above LISTED_HEIGHT
    }
    for (uint32_t height = tree.height + 1; height <= TREE_MAX_HEIGHT; ++height) tree.first[height] = tree.nodes;
    return tree;
}

} // namespace gnomon::techniques::per_triangle_volumes
