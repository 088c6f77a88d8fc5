// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require

layout(set = 0, binding = 0) uniform usampler2DArray from;
layout(set = 0, binding = 1) writeonly uniform uimage2DArray to;

#define VALUE uvec4
VALUE load(ivec3 p) { return texelFetch(from, p, 0); }
void store(ivec3 p, VALUE v) { imageStore(to, p, v); }
#include "src/shadow/parts/summed_area_scan.glsl"

void main() { scan_rows(textureSize(from, 0).xy); }
