// SPDX-License-Identifier: Apache-2.0
// How much of a light stands above a receiver's plane: what the receiver hides by itself, in closed form, so that maps need not.
#ifndef GNOMON_LIGHT_HORIZON_GLSL
#define GNOMON_LIGHT_HORIZON_GLSL
#include "shaders/light.glsl"

// Part of a unit disk on the positive side of a line whose signed distance from its centre is q.
float disk_above(float q)
{
    q = clamp(q, -1.0, 1.0);
    return 0.5 + (q * sqrt(1.0 - q * q) + asin(q)) / 3.14159265358979;
}

// Part of the square [-1, 1]^2 where a + b u + c v > 0: second differences of the half squares of its positive part, over 4 b c.
float square_above(float a, float b, float c)
{
    b = abs(b), c = abs(c);
    if (b < c) {
        const float t = b;
        b = c;
        c = t;
    }
    if (b + c <= abs(a)) return a > 0.0 ? 1.0 : 0.0;
    // the second side nearly level: one axis alone
    if (c < 1e-4 * b) return clamp(0.5 + 0.5 * a / b, 0.0, 1.0);
    const vec4 f = max(vec4(a + b + c, a + b - c, a - b + c, a - b - c), 0.0);
    return clamp(dot(f * f, vec4(1.0, -1.0, -1.0, 1.0)) / (8.0 * b * c), 0.0, 1.0);
}

float light_above_horizon(Light light, vec3 p_world, vec3 n)
{
    const vec4 to = to_light(light, p_world);
    if (light.kind == LIGHT_RECT) {
        const vec3 d = light.position - p_world;
        return square_above(dot(n, d), dot(n, light.half_u), dot(n, light.half_v));
    }
    // distance of the centre from the plane, and how far a disk of the light's radius reaches along the plane's normal
    const vec3 axis = light.kind == LIGHT_DISK ? light.direction : to.xyz;
    const float across = sqrt(max(0.0, 1.0 - dot(n, axis) * dot(n, axis)));
    const float height = light.kind == LIGHT_DIRECTIONAL ? dot(n, to.xyz) : dot(n, to.xyz) * to.w;
    const float reach = across * (light.kind == LIGHT_DIRECTIONAL ? tan(light.radius) : light.radius);
    if (reach <= abs(height)) return height > 0.0 ? 1.0 : 0.0;
    return disk_above(height / reach);
}

#endif
