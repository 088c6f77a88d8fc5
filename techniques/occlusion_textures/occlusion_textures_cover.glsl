// SPDX-License-Identifier: Apache-2.0
// Which of a group's slices cover a texel; or, `joined`, which cover it together with all nearer ones, as the light's centre sees them.
#ifndef GNOMON_OCCLUSION_TEXTURES_COVER_GLSL
#define GNOMON_OCCLUSION_TEXTURES_COVER_GLSL
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

layout(set = 0, binding = 0) uniform sampler2DArray slices;
layout(set = 1, binding = 0, scalar) uniform Constants { GroupConstants c; };

bvec4 covers(ivec2 texel, int group, int layer)
{
    vec4 content = texelFetch(slices, ivec3(texel, group * c.layers + layer), 0);
    if (c.joined != 0) {
        for (int nearer = 0; nearer < group; ++nearer) {
            const vec4 before = texelFetch(slices, ivec3(texel, nearer * c.layers + layer), 0);
            content.x = max(content.x, max(max(before.x, before.y), max(before.z, before.w)));
        }
        content.y = max(content.x, content.y);
        content.z = max(content.y, content.z);
        content.w = max(content.z, content.w);
    }
    return greaterThan(content, vec4(0.0));
}

#endif
