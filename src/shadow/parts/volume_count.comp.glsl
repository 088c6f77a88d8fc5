// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/casters.shared.h"
#include "src/shadow/parts/volume_mask.shared.h"

// How many casters are dropped, and of those that are left how many bands.
layout(local_size_x = VOLUME_CULL_GROUP) in;
layout(set = 0, binding = 0, scalar) readonly buffer Casters { Caster casters[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Slots { uint slots[]; };
layout(set = 0, binding = 2, scalar) buffer Counts { uint casters_culled, bands_culled; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeMaskConstants c; };

void main()
{
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= c.slots || casters[slot].blended != 0u) return;
    if (slots[slot] == 0u) atomicAdd(casters_culled, 1u);
    else atomicAdd(bands_culled, c.bands - uint(bitCount(slots[slot])));
}
