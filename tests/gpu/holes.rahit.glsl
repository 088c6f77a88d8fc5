// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_ray_tracing : require

// A triangle with a hole: its left half lets the ray through.
void main()
{
    if (gl_WorldRayOriginEXT.x < 0.0) ignoreIntersectionEXT;
}
