// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray values;
layout(location = 0) out vec2 min_max;

void main() { min_max = texelFetch(values, ivec3(gl_FragCoord.xy, layer), 0).rr; }
