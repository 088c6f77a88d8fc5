// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_map.glsl"
#include "src/shadow/parts/bias.shared.h"

// Two depths a texel become one that lies between them: b behind the first where there is no second.
layout(set = 0, binding = 0) uniform sampler2DArray first_image;
layout(set = 0, binding = 1) uniform sampler2DArray second_image;
layout(set = 1, binding = 0, scalar) uniform Constants { BiasLayersConstants c; };

layout(location = 0) flat in int layer;

void main()
{
    const ivec3 at = ivec3(gl_FragCoord.xy, layer);
    const float z1 = texelFetch(first_image, at, 0).r, z2 = texelFetch(second_image, at, 0).r;
    gl_FragDepth = 0.0;
    if (z1 == 0.0) return;
    const LightMapLayer l = c.map.layers[layer];
    const float depth = depth_from_stored(l, z1);
    const vec2 texel = project(l, world_from_map(l, gl_FragCoord.xy / c.map.size, depth)).texel;
    const float b = c.constant + c.texels * max(texel.x, texel.y);
    float offset = b;
    if (z2 > 0.0) offset = 0.5 * (depth_from_stored(l, z2) - depth);
    if (c.capped != 0) offset = min(offset, b);
    gl_FragDepth = clamp(stored_from_depth(l, depth + offset), 0.0, 1.0);
}
