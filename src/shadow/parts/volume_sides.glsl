// SPDX-License-Identifier: Apache-2.0
// Triangles' corners in the world, and on which side of them the light lies.
#ifndef GNOMON_VOLUME_SIDES_GLSL
#define GNOMON_VOLUME_SIDES_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/scene.glsl"
#include "src/shadow/parts/volumes.shared.h"

// The same bits wherever a vertex is placed, or faces that share it come apart.
vec3 placed(Instance i, vec3 p)
{
    precise const vec3 world = transform_point(i, p);
    return world;
}

// From p to the light, of any length.
vec3 light_from(Light light, vec3 p)
{
    precise const vec3 ray = light.kind == LIGHT_DIRECTIONAL ? -light.direction : light.position - p;
    return ray;
}

// 1 where the light lies before the triangle, -1 behind it; 0 in its plane, as far as can be told: its volume is then flat, and left out as
// a whole. So are triangles with corners that are no numbers. Of closed meshes no triangle may be left out.
int light_side(Light light, vec3 a, vec3 b, vec3 c, bool closed)
{
    const vec3 u = b - a, v = c - a, ray = light_from(light, a);
    const float side = dot(cross(u, v), ray);
    // roundings of the product; and of the corners' and a near light's places
    const float rounding = 4e-7 * length(ray) + (light.kind == LIGHT_DIRECTIONAL ? 0.0 : 1.2e-7 * (length(a) + length(light.position)));
    if (!closed && !(abs(side) > length(u) * length(v) * rounding)) return 0;
    return side >= 0.0 ? 1 : -1;
}

#endif
