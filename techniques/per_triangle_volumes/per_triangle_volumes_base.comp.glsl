// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"
#define TREE c.tree

// The lowest nodes: which of their samples some triangle may darken, and between which depths these lie.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, scalar) writeonly buffer Words { uint words[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Tiles { uint tiles[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { TreeConstants c; };

#include "techniques/per_triangle_volumes/tree.glsl"

void main()
{
    const uint index = gl_GlobalInvocationID.x;
    if (index >= TREE.first[2]) return;
    const uvec2 node = uvec2(index % TREE.width[1], index / TREE.width[1]);
    uint done = 0;
    vec2 depths = vec2(NOWHERE, 0.0);
    for (uint i = 0; i < 32; ++i) {
        const uvec2 at = child_of(1, node, i);
        bool lit = all(lessThan(at, TREE.samples));
        if (lit) {
            Receiver r;
            float visibility;
            lit = find_hard_receiver(c.view, c.light, depth_image, normal_image, vec2(pixel_of(at)) + 0.5, r, visibility);
            const float z = receiver_depth(depth_on(texelFetch(depth_image, ivec2(pixel_of(at)), 0), at));
            if (lit) depths = vec2(min(depths.x, z), max(depths.y, z));
        }
        done |= uint(!lit) << i;
    }
    words[index] = done;
    tiles[tile_index(1, node)] = pack_depths(depths);
}
