// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(set = 0, binding = 0) uniform sampler2D receivers;
layout(set = 0, binding = 1) uniform usampler2D counts;

layout(location = 0) out float visibility;

void main()
{
    const vec4 receiver = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0);
    visibility = receiver.w < 0.0 ? receiver.x : texelFetch(counts, ivec2(gl_FragCoord.xy), 0).x == 0 ? 1.0 : 0.0;
}
