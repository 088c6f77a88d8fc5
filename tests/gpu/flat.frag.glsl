// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(set = 1, binding = 0, scalar) uniform Constants { vec4 value; };
layout(location = 0) out vec4 color;

void main() { color = value; }
