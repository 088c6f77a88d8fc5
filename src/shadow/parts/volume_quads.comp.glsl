// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "src/shadow/parts/volume_sides.glsl"

layout(constant_id = 0) const uint EDGES = VOLUME_EDGES_ANY;
layout(constant_id = 1) const bool COUNTED = false;
layout(constant_id = 2) const bool REPEATED = false; // a stencil counts by one: as many quads as the weight says, and its sign by their winding

layout(local_size_x = VOLUME_GROUP) in;

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Blocks { VolumeBlock blocks[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Sides { int sides[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Edges { VolumeEdge edges[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Quads { VolumeQuad quads[]; };
layout(set = 0, binding = 7, scalar) buffer Draws { uint draws[4 * VOLUME_DRAWS]; };
layout(set = 0, binding = 8, scalar) buffer Work { VolumeWork work; };
layout(set = 0, binding = 9, scalar) readonly buffer SlotBands { uint slot_bands[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeTask c; };

// A triangle's side of the edge counts from one end to the other where the light lies before it and it runs through the edge that way.
int side_of(uint first_primitive, uint entry)
{
    const int side = sides[first_primitive + (entry >> 1)];
    return (entry & 1) != 0 ? -side : side;
}

// How many of the sides that triangles' volumes have at the edge are left when opposite ones cancel, with the direction as sign (Aldridge
// and Woods 2004; Kim et al. 2008). 0: none is to be drawn.
int weight_of(uint first_primitive, VolumeEdge edge)
{
    const bool alone = edge.second == VOLUME_ALONE;
    if (!alone && (edge.second & VOLUME_LIST) != 0) {
        if (EDGES != VOLUME_EDGES_ANY) return 0;
        int sum = 0;
        for (uint k = 0; k < (edge.second & ~VOLUME_LIST); ++k) sum += side_of(first_primitive, lists[edge.first + k]);
        return sum;
    }
    const int first = side_of(first_primitive, edge.first);
    if (alone) return EDGES == VOLUME_EDGES_CLOSED ? 0 : first;
    if (EDGES == VOLUME_EDGES_ANY) return first + side_of(first_primitive, edge.second);
    // a silhouette: the light before one, behind the other
    return sides[first_primitive + (edge.first >> 1)] != sides[first_primitive + (edge.second >> 1)] ? 2 * first : 0;
}

void repeat_quad(Instance i, VolumeEdge edge, int weight, uint slot)
{
    const uint times = EDGES == VOLUME_EDGES_CLOSED ? 1 : uint(abs(weight)); // as the caps of closed meshes, which all count twice
    const uint place = atomicAdd(draws[4 * VOLUME_QUADS], 6 * times) / 6;
    if (COUNTED) atomicAdd(work.quads, times);
    const vec3 from = placed(i, positions[i.first_vertex + (weight > 0 ? edge.from : edge.to)]);
    const vec3 to = placed(i, positions[i.first_vertex + (weight > 0 ? edge.to : edge.from)]);
    for (uint k = 0; k < times; ++k) quads[place + k] = VolumeQuad(from, to, 1, slot);
}

void main()
{
    const uint index = c.first_block + gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (index >= c.first_block + c.blocks) return;
    const VolumeBlock block = blocks[index];
    const bool in_block = gl_LocalInvocationIndex < block.count && (c.bands.count == 0 || slot_bands[block.slot] != 0);
    const Instance i = instances[block.slot];
    VolumeEdge edge = VolumeEdge(0, 0, 0, VOLUME_ALONE);
    if (in_block) edge = edges[block.first + gl_LocalInvocationIndex];
    const int weight = in_block ? weight_of(i.first_primitive, edge) : 0;
    if (REPEATED) {
        if (weight != 0) repeat_quad(i, edge, weight, block.slot);
        return;
    }
    const uvec4 drawn = subgroupBallot(weight != 0);
    uint place = 0;
    if (subgroupElect()) {
        place = atomicAdd(draws[4 * VOLUME_QUADS], 6 * subgroupBallotBitCount(drawn)) / 6;
        if (COUNTED) atomicAdd(work.quads, subgroupBallotBitCount(drawn));
    }
    place = subgroupBroadcastFirst(place) + subgroupBallotExclusiveBitCount(drawn);
    if (weight == 0) return;
    quads[place] = VolumeQuad(placed(i, positions[i.first_vertex + edge.from]), placed(i, positions[i.first_vertex + edge.to]), weight, block.slot);
}
