// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

// Gives every list its room. Which room is chance, and no result depends on it: a prefix sum over all cells would only make it repeat.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 1, scalar) writeonly buffer Draw { uint vertices, instance_count, first_vertex, first_instance; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (i == 0) {
        vertices = first_vertex = first_instance = 0;
        instance_count = 1;
    }
    const uint own = i < count ? cells[i].count : 0;
    const uint all = subgroupAdd(own);
    if (all == 0) return;
    uint first = 0;
    if (subgroupElect()) first = atomicAdd(listed, all);
    first = subgroupBroadcastFirst(first) + subgroupExclusiveAdd(own);
    if (own == 0) return;
    cells[i].first = first;
    cells[i].left = own;
}
