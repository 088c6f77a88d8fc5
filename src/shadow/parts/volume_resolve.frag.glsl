// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volumes.shared.h"

layout(set = 0, binding = 0) uniform usampler2D receivers;
layout(set = 0, binding = 1) uniform sampler2D counts;

layout(location = 0) out float visibility;

void main()
{
    const uvec2 receiver = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xw;
    visibility = receiver.y == VOLUME_ASIDE ? uintBitsToFloat(receiver.x) : texelFetch(counts, ivec2(gl_FragCoord.xy), 0).x == 0.0 ? 1.0 : 0.0;
}
