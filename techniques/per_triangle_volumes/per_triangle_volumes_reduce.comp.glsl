// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

// The nodes of one height from their children.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) buffer Words { uint words[]; };
layout(set = 0, binding = 1, scalar) buffer Tiles { uint tiles[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { Tree tree; uint height; };

#define TREE tree
#include "techniques/per_triangle_volumes/tree.glsl"

void main()
{
    const uint end = height == tree.height ? tree.nodes : tree.first[height + 1];
    const uint offset = gl_GlobalInvocationID.x, index = tree.first[height] + offset;
    if (index >= end) return;
    const uvec2 node = uvec2(offset % tree.width[height], offset / tree.width[height]);
    const uint rows = (tree.first[height] - tree.first[height - 1]) / tree.width[height - 1];
    uint done = 0;
    uvec2 codes = uvec2(NO_TILE, 0);
    for (uint i = 0; i < 32; ++i) {
        const uvec2 child = child_of(height, node, i);
        bool open = all(lessThan(child, uvec2(tree.width[height - 1], rows)));
        if (open) {
            const uint at = node_index(height - 1, child);
            open = words[at] != 0xffffffffu;
            const uint code = tiles[tile_index(index, i)];
            if (open) codes = uvec2(min(codes.x, code & 0xffffu), max(codes.y, code >> 16));
        }
        done |= uint(!open) << i;
    }
    words[index] = done;
    tiles[tile_index(height, node)] = codes.x | codes.y << 16;
}
