// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/host/gather_source.glsl"

layout(set = 0, binding = 1, scalar) writeonly buffer Target { uint indices[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= c.count) return;
    const uint index = c.given == 0 ? i : c.format != 0 ? read_16(c.offset + 2 * i) : read_32(c.offset + 4 * i);
    const uint corner = i % 3;
    const uint place = c.turned != 0 && corner != 0 ? i - corner + 3 - corner : i;
    // an index beyond the mesh would reach into a neighbour's vertices
    indices[c.first + place] = min(index, c.vertices - 1);
}
