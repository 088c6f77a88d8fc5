// SPDX-License-Identifier: Apache-2.0
// What lights send, shadow aside: each at its centre (book, eq. 1.5: direct illumination evaluated at one sample).
#ifndef GNOMON_EMISSION_GLSL
#define GNOMON_EMISSION_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"

// Irradiance at normal incidence from `l` = to_light(light, p).
vec3 irradiance(Light light, vec4 l)
{
    if (light.kind == LIGHT_DIRECTIONAL) return light.radiance;
    // Inside the light's own radius the inverse square no longer holds.
    const float distance_squared = max(l.w * l.w, max(light.radius * light.radius, 1e-6));
    const float cos_axis = -dot(l.xyz, light.direction);
    float shape = 1.0;
    if (light.kind == LIGHT_SPOT) shape = smoothstep(light.cos_outer, max(light.cos_inner, light.cos_outer + 1e-4), cos_axis);
    if (light.kind == LIGHT_RECT || light.kind == LIGHT_DISK) shape = max(cos_axis, 0.0);
    return light.radiance * shape / distance_squared;
}

// Radiance of the surroundings from direction d.
vec3 hemisphere(vec3 sky, vec3 ground, vec3 d) { return mix(ground, sky, 0.5 + 0.5 * d.y); }

#endif
