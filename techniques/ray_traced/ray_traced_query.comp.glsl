// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_query : require
#include "techniques/ray_traced/ray_traced.glsl"
#include "shaders/occluded_query.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    if (all(lessThan(gl_GlobalInvocationID.xy, uvec2(c.view.size)))) write_pixel(gl_GlobalInvocationID.xy);
}
