// SPDX-License-Identifier: Apache-2.0
// How many new pages each run of the table's entries has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Marks { uint marks[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CountsOf { Counts counts; };
layout(set = 0, binding = 2, scalar) readonly buffer Table { uint table[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Runs { uint runs[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"

void main()
{
    const uint begin = gl_GlobalInvocationID.x * VIRTUAL_RUN;
    if (begin >= c.grid.entries) return;
    const uint end = min(begin + VIRTUAL_RUN, c.grid.entries);
    uint fresh = 0u;
    for (uint e = begin; e < end && marks[run_mark(begin)] != 0u; ++e)
        if ((marks[e] >> counts.coarser & 1u) != 0u && table[e] == 0u) ++fresh;
    runs[gl_GlobalInvocationID.x] = fresh;
}
