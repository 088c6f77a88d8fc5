// SPDX-License-Identifier: Apache-2.0
// Lights as points: the GLSL twin of scene::light_point and scene::reaches (tests/gpu/light_test.cpp holds them together).
#ifndef GNOMON_LIGHT_GLSL
#define GNOMON_LIGHT_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.shared.h"

// Two unit vectors that complete n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
void orthonormal_basis(vec3 n, out vec3 t, out vec3 b)
{
    const float s = n.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (s + n.z);
    const float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

// Towards the light's centre: xyz unit direction, w distance (directional: infinite, given as 1e30).
vec4 to_light(Light light, vec3 p_world)
{
    if (light.kind == LIGHT_DIRECTIONAL) return vec4(-light.direction, 1e30);
    const vec3 d = light.position - p_world;
    const float distance = length(d);
    return vec4(d / max(distance, 1e-20), distance);
}

// Whether the receiver's plane lets the light's centre in: techniques that treat the light as its centre write 0 where it does not.
bool faces_light(Light light, vec3 p_world, vec3 n_geometric)
{
    return dot(n_geometric, to_light(light, p_world).xyz) > 0.0;
}

bool light_reaches(Light light, vec3 p_world)
{
    if (light.kind == LIGHT_DIRECTIONAL || light.kind == LIGHT_POINT) return true;
    const vec3 from = p_world - light.position;
    if (light.kind == LIGHT_SPOT) return dot(from, light.direction) >= light.cos_outer * length(from);
    return dot(from, light.direction) > 0.0;
}

// Shirley and Chiu's concentric map of [0,1)^2 onto the unit disk (1997): equal area, and neighbours stay neighbours.
vec2 square_to_disk(vec2 u)
{
    const vec2 a = 2.0 * u - 1.0;
    if (a == vec2(0.0)) return a;
    const bool wide = abs(a.x) > abs(a.y);
    const float r = wide ? a.x : a.y;
    const float phi = wide ? 0.7853981633974483 * (a.y / a.x) : 1.5707963267948966 - 0.7853981633974483 * (a.x / a.y);
    return r * vec2(cos(phi), sin(phi));
}

// xyz: where u in [0,1)^2 falls on the light as p sees it, w = 1; directional: the unit direction towards it, w = 0.
vec4 light_point(Light light, vec3 p_world, vec2 u)
{
    if (light.kind == LIGHT_RECT) return vec4(light.position + (2.0 * u.x - 1.0) * light.half_u + (2.0 * u.y - 1.0) * light.half_v, 1.0);
    const vec2 d = square_to_disk(u);
    if (light.kind == LIGHT_DISK) return vec4(light.position + d.x * light.half_u + d.y * light.half_v, 1.0);
    vec3 t, b;
    if (light.kind == LIGHT_DIRECTIONAL) {
        // Equal solid angle: 1 - cos(theta) = r^2 (1 - cos(alpha)), and 1 - cos(alpha) = 2 sin^2(alpha / 2): no cancellation for a
        // sun of a quarter of a degree.
        const float s = sin(0.5 * light.radius);
        const float k = 2.0 * s * s;
        const float z = k * dot(d, d);
        orthonormal_basis(-light.direction, t, b);
        return vec4(sqrt(k * (2.0 - z)) * (d.x * t + d.y * b) - (1.0 - z) * light.direction, 0.0);
    }
    const vec3 from = p_world - light.position;
    const float distance = length(from);
    if (light.radius == 0.0 || distance == 0.0) return vec4(light.position, 1.0);
    orthonormal_basis(from / distance, t, b);
    return vec4(light.position + light.radius * (d.x * t + d.y * b), 1.0);
}

#endif
