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
    if (light.kind == LIGHT_SPOT) return dot(from, light.direction) > light.cos_outer * length(from);
    return dot(from, light.direction) > 0.0;
}

// Uniform in area: u in [0,1)^2 -> unit disk.
vec2 disk_point(vec2 u)
{
    const float r = sqrt(u.x), phi = 6.283185307179586 * u.y;
    return r * vec2(cos(phi), sin(phi));
}

vec4 light_point(Light light, vec3 p_world, vec2 u)
{
    vec3 t, b;
    if (light.kind == LIGHT_DIRECTIONAL) {
        const vec3 axis = -light.direction;
        if (light.radius == 0.0) return vec4(axis, 0.0);
        // 1 - cos r = 2 sin^2(r/2): no cancellation for a sun of a quarter of a degree
        const float s = sin(0.5 * light.radius);
        const float one_minus_cos = u.x * 2.0 * s * s;
        const float sin_theta = sqrt(max(0.0, one_minus_cos * (2.0 - one_minus_cos))), phi = 6.283185307179586 * u.y;
        orthonormal_basis(axis, t, b);
        return vec4(normalize((1.0 - one_minus_cos) * axis + sin_theta * (cos(phi) * t + sin(phi) * b)), 0.0);
    }
    if (light.kind == LIGHT_RECT) return vec4(light.position + (2.0 * u.x - 1.0) * light.half_u + (2.0 * u.y - 1.0) * light.half_v, 1.0);
    const vec2 d = disk_point(u);
    if (light.kind == LIGHT_DISK) return vec4(light.position + d.x * light.half_u + d.y * light.half_v, 1.0);
    if (light.radius == 0.0) return vec4(light.position, 1.0);
    orthonormal_basis(normalize(p_world - light.position), t, b);
    return vec4(light.position + light.radius * (d.x * t + d.y * b), 1.0);
}

#endif
