// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "src/shadow/parts/volume_triangles.glsl"

layout(constant_id = 1) const bool COUNTED = false;

layout(set = 0, binding = 4, scalar) readonly buffer Sides { int sides[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Caps { VolumeCap caps[]; };
layout(set = 0, binding = 6, scalar) buffer Draws { uint draws[4 * VOLUME_DRAWS]; };
layout(set = 0, binding = 7, scalar) buffer Work { VolumeWork work; };
layout(set = 0, binding = 8, scalar) readonly buffer SlotBands { uint slot_bands[]; };

// Counting from the eye, a cap counts only where the eye sees through it: it is then not in the depth buffer. That is so for triangles
// that are not drawn, and before the near plane.
bool seen_through(VolumeBlock block, vec3 p[3])
{
    if ((block.flags & VOLUME_UNSEEN) != 0) return true;
    const vec3 to_eye = c.view.orthographic != 0 ? -c.view.forward : c.view.eye - p[0];
    if ((block.flags & VOLUME_ONE_SIDED) != 0 && dot(cross(p[1] - p[0], p[2] - p[0]), to_eye) <= 0.0) return true;
    bool nearer = false, before_eye = false;
    for (uint k = 0; k < 3; ++k) {
        const vec4 clip = c.view.clip_from_world * vec4(p[k], 1.0);
        nearer = nearer || clip.z >= 0.999 * clip.w;
        before_eye = before_eye || clip.w > 0.0;
    }
    return nearer && before_eye;
}

void main()
{
    const uint index = c.first_block + gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
    if (index >= c.first_block + c.blocks) return;
    const VolumeBlock block = blocks[index];
    const Instance i = instances[block.slot];
    const uint triangle = block.first + gl_LocalInvocationIndex;
    bool drawn = gl_LocalInvocationIndex < block.count && (c.bands.count == 0 || slot_bands[block.slot] != 0);
    vec3 p[3] = vec3[](vec3(0.0), vec3(0.0), vec3(0.0));
    int side = 1;
    if (drawn) {
        p = corners_of(i, triangle);
        side = sides[i.first_primitive + triangle];
        drawn = side != 0 && (c.count == VOLUME_ZFAIL || c.count == VOLUME_ZP_PLUS || seen_through(block, p));
    }
    const uvec4 mask = subgroupBallot(drawn);
    uint place = 0;
    if (subgroupElect()) {
        place = atomicAdd(draws[4 * VOLUME_NEAR_CAPS], 3 * subgroupBallotBitCount(mask)) / 3;
        if (c.far_caps != 0) atomicAdd(draws[4 * VOLUME_FAR_CAPS], 3 * subgroupBallotBitCount(mask));
        if (COUNTED) atomicAdd(work.caps, subgroupBallotBitCount(mask) * (1 + c.far_caps));
    }
    place = subgroupBroadcastFirst(place) + subgroupBallotExclusiveBitCount(mask);
    if (!drawn) return;
    // closed meshes: those that the light sees close the near end, the others the far one, and sides count twice
    const int weight = c.edges == VOLUME_EDGES_CLOSED ? 2 * side : 1;
    caps[place] = VolumeCap(p[0], side > 0 ? p[1] : p[2], side > 0 ? p[2] : p[1], weight, block.slot);
}
