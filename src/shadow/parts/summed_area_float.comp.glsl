// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(set = 0, binding = 0) uniform sampler2DArray from;
layout(set = 0, binding = 1) writeonly uniform image2DArray to;
layout(set = 1, binding = 0, scalar) uniform Constants { vec4 centre; }; // taken off every texel

#define VALUE vec4
VALUE load(ivec3 p) { return texelFetch(from, p, 0) - centre; }
void store(ivec3 p, VALUE v) { imageStore(to, p, v); }
#include "src/shadow/parts/summed_area_scan.glsl"

void main() { scan_rows(textureSize(from, 0).xy); }
