// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray from;
layout(location = 0) out vec4 to;

void main() { to = texelFetch(from, ivec3(gl_FragCoord.xy, layer), 0); }
