// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(set = 0, binding = 0) uniform sampler2DArray from;
layout(set = 0, binding = 1) writeonly uniform uimage2DArray to;
layout(set = 1, binding = 0, scalar) uniform Constants { float steps; }; // counts of the value 1

#define VALUE uvec4
// roundEven and not + 0.5, which would carry 2^24 - 1 to 2^24
VALUE load(ivec3 p) { return uvec4(roundEven(clamp(texelFetch(from, p, 0), 0.0, 1.0) * steps)); }
void store(ivec3 p, VALUE v) { imageStore(to, p, v); }
#include "src/shadow/parts/summed_area_scan.glsl"

void main() { scan_rows(textureSize(from, 0).xy); }
