// SPDX-License-Identifier: Apache-2.0
// Invocations that walk the tree together, each with every so many of the 32 children of a node. A team is a subgroup of any size, or, with
// TEAM_IN_SHARED_MEMORY, a group of 32 that exchanges bits through shared memory and barriers, for devices without ballots.
#ifndef GNOMON_TEAM_GLSL
#define GNOMON_TEAM_GLSL
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"

layout(local_size_x = 32) in;

#ifdef TEAM_IN_SHARED_MEMORY

shared uint team_word;
#define TEAM_BARRIER barrier()
#define TEAMS_A_GROUP 1

const uint team_lanes = 32;
uint team_lane() { return gl_LocalInvocationIndex; }
uint team_in_group() { return 0; }
uint team_index() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
bool team_elect() { return gl_LocalInvocationIndex == 0; }

uint team_or(uint bits)
{
    barrier();
    if (gl_LocalInvocationIndex == 0) team_word = 0;
    barrier();
    if (bits != 0) atomicOr(team_word, bits);
    barrier();
    return team_word;
}

uvec2 team_same(uvec2 value) { return value; }

struct TeamWords {
    uint first;
};
TeamWords team_load(uint first) { return TeamWords(first); }
#define team_word_of(w, i) volume_words[w.first + (i)]

// The same value for all, whatever others write meanwhile to where it came from.
uint team_first(uint value)
{
    barrier();
    if (gl_LocalInvocationIndex == 0) team_word = value;
    barrier();
    return team_word;
}
uvec2 team_first(uvec2 value) { return uvec2(team_first(value.x), team_first(value.y)); }

#else

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

#define TEAMS_A_GROUP 32
#define TEAM_BARRIER subgroupMemoryBarrierShared()
#define team_lanes gl_SubgroupSize
uint team_lane() { return gl_SubgroupInvocationID; }
uint team_in_group() { return gl_SubgroupID; }
uint team_index() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_NumSubgroups + gl_SubgroupID; }
bool team_elect() { return subgroupElect(); }
// Lavapipe takes a loop over lanes for it, as it does for a ballot.
uint team_or(uint bits) { return subgroupOr(bits); }
// What lavapipe is to read once instead of lane by lane must come from here, by way of one lane that differs from the others.
uint team_first(uint value) { return subgroupBroadcastFirst(value); }
uvec2 team_first(uvec2 value) { return subgroupBroadcastFirst(value); }
// Of a value that is the same for all: says so to the compiler. Lavapipe fetches by lanes what depends on others.
uvec2 team_same(uvec2 value) { return subgroupBroadcastFirst(value); }

// VOLUME_WORDS words, each read by one lane and handed to all: lavapipe reads lane by lane what all of them read.
struct TeamWords {
    uint own[8];
};
TeamWords team_load(uint first)
{
    TeamWords w;
    for (uint k = 0; k < 8; ++k)
        if (k * gl_SubgroupSize + gl_SubgroupInvocationID < VOLUME_WORDS) w.own[k] = volume_words[first + k * gl_SubgroupSize + gl_SubgroupInvocationID];
    return w;
}
#define team_word_of(w, i) subgroupBroadcast(w.own[(i) / gl_SubgroupSize], (i) % gl_SubgroupSize)

#endif

// Children that are still to be descended into, by height, and which of them lie inside of the volume. In registers this stack would be
// indexed memory of every lane.
shared uint team_stack[TEAMS_A_GROUP][TREE_MAX_HEIGHT + 1], team_certain[TEAMS_A_GROUP][TREE_MAX_HEIGHT + 1];

#endif
