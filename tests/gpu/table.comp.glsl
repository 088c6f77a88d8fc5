// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_nonuniform_qualifier : require

layout(local_size_x = 8) in;
layout(set = 0, binding = 0, std430) writeonly buffer Out { vec4 seen[]; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i < 6u) seen[i] = textureLod(textures[nonuniformEXT(i % 3u)], vec2(0.5), i < 3u ? 0.0 : 8.0);
}
