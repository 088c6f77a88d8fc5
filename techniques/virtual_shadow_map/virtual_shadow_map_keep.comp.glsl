// SPDX-License-Identifier: Apache-2.0
// Which pages of earlier frames serve this one, and which hold what has moved since.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Marks { uint marks[]; };
layout(set = 0, binding = 1, scalar) buffer CountsOf { Counts counts; };
layout(set = 0, binding = 2, scalar) buffer Slots { Slot slots[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Table { uint table[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Moved { Box moved[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"
#include "techniques/virtual_shadow_map/virtual_counts.glsl"
#include "techniques/virtual_shadow_map/virtual_page.glsl"

bool holds_moved(uvec2 id)
{
    const PageDraw d = page_draw(id, 0u);
    for (uint i = 0; i < c.moved; ++i)
        if (reaches(d, moved[i].centre, moved[i].extent)) return true;
    return false;
}

void main()
{
    const uint slot = gl_GlobalInvocationID.x;
    const uint lowered = levels_lowered();
    if (slot == 0u) counts.coarser = lowered, counts.clear_vertices = 3u;
    if (slot >= uint(c.grid.pool)) return;
    const uvec2 id = slots[slot].page;
    if (id.x == VIRTUAL_NO_PAGE) return;
    if (holds_moved(id)) {
        slots[slot] = Slot(uvec2(VIRTUAL_NO_PAGE), 0u);
        return;
    }
    if (!in_window(level_of(id), place_of(id))) return;
    const uint entry = entry_of(id);
    if ((marks[entry] >> lowered & 1u) == 0u) return;
    slots[slot].used = c.frame;
    table[entry] = slot + 1u;
    atomicAdd(counts.kept, 1u);
}
