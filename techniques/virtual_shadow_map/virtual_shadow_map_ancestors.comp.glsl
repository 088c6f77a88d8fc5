// SPDX-License-Identifier: Apache-2.0
// From requested pages to the coarser ones that hold them: which pages samples use with requests lowered by b levels, and how many.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer Marks { uint marks[]; };
layout(set = 0, binding = 1, scalar) buffer CountsOf { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"

void mark_ancestors(uvec2 id)
{
    atomicAdd(counts.requested[0], 1u);
    int level = level_of(id);
    ivec2 place = place_of(id);
    for (int b = 1; b < c.grid.levels; ++b) {
        if (level > 0) --level, place >>= 1;
        const uint entry = entry_of(face_of(id), level, place), bit = 1u << b;
        if ((atomicOr(marks[entry], bit) & bit) != 0u) break; // whoever was here goes on
        atomicAdd(counts.requested[b], 1u);
        marks[run_mark(entry)] = 1u;
    }
}

void main()
{
    const uint begin = gl_GlobalInvocationID.x * VIRTUAL_RUN;
    if (begin >= c.grid.entries || marks[run_mark(begin)] == 0u) return;
    const uint end = min(begin + VIRTUAL_RUN, c.grid.entries);
    for (uint e = begin; e < end; ++e)
        if ((marks[e] & 1u) != 0u) mark_ancestors(id_of_entry(e));
}
