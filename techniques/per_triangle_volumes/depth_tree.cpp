// SPDX-License-Identifier: Apache-2.0
#include "techniques/per_triangle_volumes/depth_tree.h"

#include "base/error.h"

namespace gnomon::techniques::per_triangle_volumes {

shaders::Tree make_tree(base::Size samples)
{
    shaders::Tree tree{};
    tree.samples = uvec2(samples.width, samples.height);
    tree.step = 1.0f / vec2(tree.samples);
    const auto nodes = [&](uint32_t height) { return ((tree.samples - 1u) >> shaders::tree_shift(height)) + 1u; };
    for (uint32_t height = 1;; ++height) {
        if (height > TREE_MAX_HEIGHT)
            base::fail("per_triangle_volumes takes pictures of up to 262144 x 131072 samples, not {} x {}; choose a smaller --size",
                samples.width, samples.height);
        tree.height = height;
        tree.first[height] = tree.nodes;
        tree.width[height] = nodes(height).x;
        tree.nodes += nodes(height).x * nodes(height).y;
        if (nodes(height) == uvec2(1)) break;
    }
    for (uint32_t height = tree.height + 1; height <= TREE_MAX_HEIGHT; ++height) tree.first[height] = tree.nodes;
    return tree;
}

} // namespace gnomon::techniques::per_triangle_volumes
