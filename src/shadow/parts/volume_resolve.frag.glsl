// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_weights.glsl"
#include "src/shadow/parts/volumes.shared.h"

layout(set = 0, binding = 0) uniform sampler2D receivers;
layout(set = 0, binding = 1) uniform sampler2D counts;
layout(set = 0, binding = 2, scalar) readonly buffer Eye { ivec4 eye; }; // what is counted where counting begins

layout(location = 0) out vec4 visibility;

void main()
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const vec4 receiver = texelFetch(receivers, pixel, 0);
    if (receiver.w < 0.0) {
        visibility = vec4(receiver.x);
    } else {
        const vec4 sum = texelFetch(counts, pixel, 0) + vec4(eye);
        visibility = vec4((COLOURED ? sum.w : sum.x) == 0.0 ? 1.0 : 0.0);
        if (COLOURED) visibility.rgb *= min(exp2(sum.rgb / float(VOLUME_LOG_PARTS)), 1.0);
    }
}
