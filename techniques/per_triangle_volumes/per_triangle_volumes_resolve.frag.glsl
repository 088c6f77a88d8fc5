// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/per_triangle_volumes/depth_tree.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, scalar) readonly buffer Words { uint words[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { Tree tree; };

#define TREE tree
#include "techniques/per_triangle_volumes/tree.glsl"

layout(location = 0) out float visibility;

// A sample is dark where its own bit or that of any node above it is set.
void main()
{
    visibility = 1.0;
    if (texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r == 0.0) return;
    uvec2 at = uvec2(gl_FragCoord.xy);
    for (uint height = 1; height <= tree.height; ++height) {
        const uint row = row_shift(height);
        const uvec2 node = at >> uvec2(row, 5 - row);
        if ((words[node_index(height, node)] >> child_bit(height, at) & 1u) != 0) visibility = 0.0;
        at = node;
    }
}
