// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/host/gather_source.glsl"
#include "shaders/scene.glsl"

layout(set = 0, binding = 1, scalar) writeonly buffer Target { VertexAttributes attributes[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= c.count) return;
    const vec2 uv = c.given != 0 ? vec2(read_float(i, 0), read_float(i, 1)) : vec2(0.0);
    attributes[c.first + i] = VertexAttributes(0, uv, 0xffffffffu);
}
