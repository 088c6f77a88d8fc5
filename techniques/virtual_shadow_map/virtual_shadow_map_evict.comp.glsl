// SPDX-License-Identifier: Apache-2.0
// Layers of the pool for the new pages: those that were not needed for longest, and among equals the first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer CountsOf { Counts counts; };
layout(set = 0, binding = 1, scalar) readonly buffer Slots { Slot slots[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Chosen { uint chosen[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };

// Frames begin at 1: empty layers come first.
uint last_used(uint slot) { return slots[slot].page.x == VIRTUAL_NO_PAGE ? 0u : slots[slot].used; }

void main()
{
    const uint slot = gl_GlobalInvocationID.x;
    if (counts.fresh == 0u || slot >= uint(c.grid.pool)) return;
    const uint used = last_used(slot);
    if (used == c.frame) return;
    uint rank = 0u;
    for (uint s = 0u; s < uint(c.grid.pool) && rank < counts.fresh; ++s)
        if (last_used(s) < used || (last_used(s) == used && s < slot)) ++rank;
    if (rank < counts.fresh) chosen[rank] = slot;
}
