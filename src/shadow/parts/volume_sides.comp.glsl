// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_sides.glsl"

layout(local_size_x = VOLUME_GROUP) in;

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Blocks { VolumeBlock blocks[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Sides { int sides[]; }; // of each primitive
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

// Decided once for a triangle, whose three edges would else each round for themselves.
void main()
{
    const uint index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (index >= c.blocks) return;
    const VolumeBlock block = blocks[index];
    if (gl_LocalInvocationIndex >= block.count) return;
    const Instance i = instances[block.slot];
    const uint triangle = block.first + gl_LocalInvocationIndex;
    vec3 p[3];
    for (uint k = 0; k < 3; ++k) p[k] = placed(i, positions[i.first_vertex + indices[i.first_index + 3 * triangle + k]]);
    sides[i.first_primitive + triangle] = light_side(c.light, p[0], p[1], p[2], c.edges == VOLUME_EDGES_CLOSED);
}
