// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(set = 1, binding = 0, scalar) uniform Constants { vec2 size; float blue; };
layout(location = 0) out vec4 color;

void main() { color = vec4(gl_FragCoord.xy / size, blue, 1.0); }
