// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

// The lowest nodes once more, without the samples that are dark by now.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, scalar) buffer Words { uint words[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Tiles { uint tiles[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { Tree tree; };
#define TREE tree

#include "techniques/per_triangle_volumes/tree.glsl"

bool is_dark(uvec2 at)
{
    for (uint height = 2; height <= tree.height; ++height) {
        const uint row = row_shift(height);
        const uvec2 node = at >> uvec2(row, 5 - row);
        if ((words[node_index(height, node)] >> child_bit(height, at) & 1u) != 0) return true;
        at = node;
    }
    return false;
}

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= tree.first[2]) return;
    const uvec2 node = uvec2(index % tree.width[1], index / tree.width[1]);
    const uint done = is_dark(node) ? 0xffffffffu : words[index];
    vec2 depths = vec2(NOWHERE, 0.0);
    for (uint open = ~done; open != 0; open &= open - 1) {
        const float z = receiver_depth(texelFetch(depth_image, ivec2(child_of(1, node, findLSB(open))), 0).r);
        depths = vec2(min(depths.x, z), max(depths.y, z));
    }
    words[index] = done;
    tiles[tile_index(1, node)] = pack_depths(depths);
}
