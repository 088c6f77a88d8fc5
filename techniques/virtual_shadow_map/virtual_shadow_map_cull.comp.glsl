// SPDX-License-Identifier: Apache-2.0
// A draw for each cluster of triangles, with an instance for each new page that it may reach into.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) buffer CountsOf { Counts counts; };
layout(set = 0, binding = 1, scalar) readonly buffer Pages { PageDraw pages[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Clusters { Cluster clusters[]; };
layout(set = 0, binding = 3, scalar) buffer Batch { uint next_pair; uint commands[]; }; // VkDrawIndexedIndirectCommand, 5 words each
layout(set = 0, binding = 4, scalar) writeonly buffer Pairs { uvec2 pairs[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { CullConstants c; };
#include "techniques/virtual_shadow_map/virtual_box.glsl"

void main()
{
    const uint cluster = gl_GlobalInvocationID.x;
    if (cluster >= c.clusters || counts.fresh <= c.first_page) return;
    const uint end = min(counts.fresh, c.first_page + c.page_count);
    const Cluster k = clusters[cluster];
    uint count = 0u;
    for (uint p = c.first_page; p < end; ++p)
        if (reaches(pages[p], k.centre, k.extent)) ++count;
    if (count == 0u) return;
    // where a cluster's pairs lie is chance, and no matter: the nearest of all depths is the same in any order
    uint at = atomicAdd(next_pair, count);
    atomicAdd(counts.pairs, count);
    commands[5u * cluster] = k.index_count;
    commands[5u * cluster + 1u] = count;
    commands[5u * cluster + 2u] = k.first_index;
    commands[5u * cluster + 3u] = uint(k.first_vertex);
    commands[5u * cluster + 4u] = at;
    for (uint p = c.first_page; p < end; ++p)
        if (reaches(pages[p], k.centre, k.extent)) pairs[at++] = uvec2(p, k.instance);
}
