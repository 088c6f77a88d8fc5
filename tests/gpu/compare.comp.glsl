// SPDX-License-Identifier: Apache-2.0
#version 460

layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform sampler2DShadow map;
layout(set = 0, binding = 1, std430) writeonly buffer Out { float lit[]; };

void main()
{
    lit[0] = textureLod(map, vec3(0.5, 0.5, 0.4), 0.0); // behind the caster
    lit[1] = textureLod(map, vec3(0.5, 0.5, 0.6), 0.0); // before it
    lit[2] = textureLod(map, vec3(-0.5, 0.5, 0.0), 0.0); // outside
}
