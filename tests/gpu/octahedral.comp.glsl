// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/octahedral.glsl"
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { vec4 cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { vec4 results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const uint code = encode_normal(cases[i].xyz);
    results[i] = vec4(decode_normal(code), uintBitsToFloat(encode_normal(decode_normal(code)) ^ code));
}
