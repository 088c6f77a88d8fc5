// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_triangles.glsl"

layout(set = 0, binding = 4, scalar) writeonly buffer Sides { int sides[]; }; // of each primitive

// Decided once for a triangle, whose three edges would else each round for themselves.
void main()
{
    const uint index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (index >= c.blocks) return;
    const VolumeBlock block = blocks[index];
    if (gl_LocalInvocationIndex >= block.count) return;
    const Instance i = instances[block.slot];
    const uint triangle = block.first + gl_LocalInvocationIndex;
    const vec3 p[3] = corners_of(i, triangle);
    sides[i.first_primitive + triangle] = light_side(c.light, p[0], p[1], p[2], c.edges == VOLUME_EDGES_CLOSED);
}
