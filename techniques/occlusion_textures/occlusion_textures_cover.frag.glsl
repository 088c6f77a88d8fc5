// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray slices;
layout(location = 0) out vec4 covered;

void main() { covered = vec4(greaterThan(texelFetch(slices, ivec3(gl_FragCoord.xy, layer), 0), vec4(0.0))); }
