// SPDX-License-Identifier: Apache-2.0
// From requested pages to the coarser ones that hold them, each counted once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer Marks { uint marks[]; };
layout(set = 0, binding = 1, scalar) buffer CountsOf { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"
#include "techniques/virtual_shadow_map/virtual_counts.glsl"

void main()
{
    const uint entry = gl_GlobalInvocationID.x;
    if (entry >= c.grid.entries || (marks[entry] & MARK_REQUESTED) == 0u) return;
    const uint id = id_of_entry(entry);
    const int level = level_of(id);
    atomicAdd(counts.direct[level], 1u);
    atomicAdd(counts.covering[level], 1u);
    ivec2 page = place_of(id);
    for (int l = level - 1; l >= 0; --l) {
        page >>= 1;
        const uint before = atomicOr(marks[entry_of(face_of(id), l, page)], MARK_COVERS);
        if ((before & MARK_COVERS) != 0u) break; // whoever was here goes on
        if (before == 0u) atomicAdd(counts.covering[l], 1u);
    }
}
