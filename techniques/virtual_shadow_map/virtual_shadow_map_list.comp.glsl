// SPDX-License-Identifier: Apache-2.0
// The new pages, in the table's order: each run begins where those before it end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Marks { uint marks[]; };
layout(set = 0, binding = 1, scalar) buffer CountsOf { Counts counts; };
layout(set = 0, binding = 2, scalar) readonly buffer Table { uint table[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Runs { uint runs[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Fresh { uvec2 fresh[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"

void main()
{
    const uint run = gl_GlobalInvocationID.x, begin = run * VIRTUAL_RUN;
    if (begin >= c.grid.entries || runs[run] == 0u) return;
    uint at = 0u;
    for (uint r = 0u; r < run; ++r) at += runs[r];
    atomicAdd(counts.fresh, runs[run]);
    const uint end = min(begin + VIRTUAL_RUN, c.grid.entries);
    for (uint e = begin; e < end; ++e)
        if ((marks[e] >> counts.coarser & 1u) != 0u && table[e] == 0u) fresh[at++] = id_of_entry(e);
}
