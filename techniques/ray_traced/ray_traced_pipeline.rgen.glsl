// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_ray_tracing : require
#include "techniques/ray_traced/ray_traced.glsl"

layout(location = 0) rayPayloadEXT uint missed;

bool occluded(vec3 origin, vec3 direction, float from, float to)
{
    missed = 0;
    traceRayEXT(scene, gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xff, 0, 0, 0, origin, from, direction, to, 0);
    return missed == 0;
}

void main()
{
    write_pixel(gl_LaunchIDEXT.xy);
}
