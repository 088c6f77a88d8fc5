// SPDX-License-Identifier: Apache-2.0
// What a fragment leaves in the slices: a channel for each, of which all but one stay 0. In its own it leaves how near the slice's beginning it
// lies, so that a blend which keeps the greatest value has both what a slice covers and what in it is nearest.
#ifndef GNOMON_OCCLUSION_TEXTURES_CONTENT_GLSL
#define GNOMON_OCCLUSION_TEXTURES_CONTENT_GLSL
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { DrawConstants c; };
layout(location = 0) out vec4 content_0;
layout(location = 1) out vec4 content_1;
layout(location = 2) out vec4 content_2;
layout(location = 3) out vec4 content_3;

vec4 content(int group, float z)
{
    const vec4 near = c.slices.near[group], far = c.slices.far[group];
    // 254 steps, rounded away from the light, so that a surface does not shadow itself
    const vec4 place = (z - far) / (near - far);
    return mix(vec4(0.0), (1.0 + floor(254.0 * place)) / 255.0, bvec4(vec4(greaterThanEqual(place, vec4(0.0))) * vec4(lessThan(place, vec4(1.0)))));
}

void leave_content()
{
    // What stands behind a panel is between no point of it and what it lights, although a side of the cube sees it before receivers.
    if (dot(c.front[gl_Layer], vec3(gl_FragCoord.xy / c.size, 1.0)) < 0.0) discard;
    const int first = gl_Layer * SLICE_GROUPS;
    content_0 = content(first, gl_FragCoord.z);
    content_1 = content(first + 1, gl_FragCoord.z);
    content_2 = content(first + 2, gl_FragCoord.z);
    content_3 = content(first + 3, gl_FragCoord.z);
}

#endif
