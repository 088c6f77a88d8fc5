// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_basic : require

// Groups for a pass with a team, or a group, for each of so many things.
layout(local_size_x = 32) in;

layout(set = 0, binding = 0, scalar) readonly buffer Work { uint work[3]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Groups { uint groups[3]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint which, most, one_a_group; };

void main()
{
    if (gl_LocalInvocationIndex != 0) return;
    const uint teams = one_a_group != 0 ? 1 : gl_NumSubgroups, things = min(work[which], most);
    const uint number = things / teams + uint(things % teams != 0);
    groups[0] = min(number, 32768);
    groups[1] = (number + 32767) / 32768;
    groups[2] = 1;
}
