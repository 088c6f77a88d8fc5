// SPDX-License-Identifier: Apache-2.0
// How much of a light stands above a receiver's plane: what the receiver hides by itself, in closed form, so that maps need not.
#ifndef GNOMON_LIGHT_HORIZON_GLSL
#define GNOMON_LIGHT_HORIZON_GLSL
#include "shaders/light.glsl"

// Radius of the disk that a round light is taken for: metres, or of a sun the tangent of its angular radius, short of half the sky.
float sun_or_radius(Light light) { return light.kind == LIGHT_DIRECTIONAL ? tan(min(light.radius, 1.55)) : light.radius; }

// Part of a unit disk on the positive side of a line whose signed distance from its centre is q.
float disk_above(float q)
{
    q = clamp(q, -1.0, 1.0);
    return 0.5 + (q * sqrt(1.0 - q * q) + asin(q)) / 3.14159265358979;
}

// Part of the square [-1, 1]^2 where a + b u + c v > 0: a trapezium's while the line crosses two opposite sides, else all but a corner,
// which is a triangle.
float square_above(float a, float b, float c)
{
    b = abs(b), c = abs(c);
    const float wide = max(b, c), narrow = min(b, c), beyond = wide + narrow - abs(a);
    if (beyond <= 0.0) return a > 0.0 ? 1.0 : 0.0;
    if (abs(a) <= wide - narrow) return 0.5 + 0.5 * a / wide;
    const float corner = beyond * beyond / (8.0 * wide * narrow);
    return a > 0.0 ? 1.0 - corner : corner;
}

// Fraction of the light's area (docs/conventions.md) on n's side of the plane through p.
float light_above_horizon(Light light, vec3 p_world, vec3 n)
{
    const vec4 to = to_light(light, p_world);
    if (light.kind == LIGHT_RECT) {
        const vec3 d = light.position - p_world;
        return square_above(dot(n, d), dot(n, light.half_u), dot(n, light.half_v));
    }
    // distance of the centre from the plane, and how far a disk of the light's radius reaches along the plane's normal; a sun's, on the
    // plane at unit distance across its direction
    const vec3 axis = light.kind == LIGHT_DISK ? light.direction : to.xyz;
    const float across = sqrt(max(0.0, 1.0 - dot(n, axis) * dot(n, axis)));
    const float height = light.kind == LIGHT_DIRECTIONAL ? dot(n, to.xyz) : dot(n, to.xyz) * to.w;
    const float reach = across * sun_or_radius(light);
    if (reach <= abs(height)) return height > 0.0 ? 1.0 : 0.0;
    return disk_above(height / reach);
}

#endif
