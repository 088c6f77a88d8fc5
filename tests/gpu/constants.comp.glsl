// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 4) in;
layout(set = 0, binding = 0, scalar) writeonly buffer Out { uint values[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint constants[4]; };

void main() { values[gl_LocalInvocationID.x] = constants[gl_LocalInvocationID.x]; }
