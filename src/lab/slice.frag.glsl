// SPDX-License-Identifier: Apache-2.0
// A G-buffer of receivers that are not there: all on one plane, each facing the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "shaders/receiver.glsl"
#include "src/lab/slice.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { SliceConstants c; };

layout(location = 0) out uvec2 normal_out;
layout(location = 1) out uint primitive_out;

void main()
{
    const vec3 p = world_from_depth(c.view, gl_FragCoord.xy, c.depth);
    const vec4 light = light_point(c.light, p, vec2(0.5));
    const uint normal = encode_normal(normalize(light.w == 0.0 ? light.xyz : light.xyz - p));
    normal_out = uvec2(normal);
    primitive_out = 0;
    gl_FragDepth = c.depth;
}
