// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/host/gather_source.glsl"

layout(set = 0, binding = 1, scalar) writeonly buffer Target { float positions[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= c.count) return;
    for (uint k = 0; k < 3; ++k) positions[3 * (c.first + i) + k] = read_float(i, k);
}
