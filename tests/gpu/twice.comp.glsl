// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { vec4 inputs[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 outputs[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    if (gl_GlobalInvocationID.x >= count) return;
    outputs[gl_GlobalInvocationID.x] = 2.0 * inputs[gl_GlobalInvocationID.x];
}
