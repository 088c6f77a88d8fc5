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

// 1 where the light lies before the triangle or in its plane, else -1. Which of the two rounding makes it does not matter, as long as
// all edges of the triangle are told the same: its volume is then flat.
int light_side(Light light, vec3 a, vec3 b, vec3 c) { return dot(cross(b - a, c - a), light_from(light, a)) >= 0.0 ? 1 : -1; }

#endif
