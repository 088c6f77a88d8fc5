// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#define MOVES

layout(set = 0, binding = 0) uniform sampler2DMS depths;

float host_depth(ivec2 pixel) { return texelFetch(depths, pixel, 0).x; }

#include "src/host/receive.glsl"

void main() { receive(ivec2(gl_FragCoord.xy)); }
