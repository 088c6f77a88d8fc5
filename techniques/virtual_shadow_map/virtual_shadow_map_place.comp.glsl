// SPDX-License-Identifier: Apache-2.0
// Puts each new page into its layer of the pool.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer CountsOf { Counts counts; };
layout(set = 0, binding = 1, scalar) readonly buffer Fresh { uvec2 fresh[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Chosen { uint chosen[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Slots { Slot slots[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Table { uint table[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Pages { PageDraw pages[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { PageConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"
#include "techniques/virtual_shadow_map/virtual_page.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= counts.fresh) return;
    const uvec2 id = fresh[i];
    const uint slot = chosen[i];
    slots[slot] = Slot(id, c.frame);
    table[entry_of(id)] = slot + 1u;
    pages[i] = page_draw(id, slot);
}
