// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/emission.glsl"
#include "shaders/receiver.glsl"
#include "src/shadow/lighting.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D albedo_image;
layout(set = 0, binding = 3) uniform sampler2D emissive_image;
layout(set = 1, binding = 0, scalar) uniform Constants { AmbientConstants c; };

layout(location = 0) out vec4 radiance;

// A plain sky: brighter towards the horizon, soft ground below it.
vec3 background(vec3 direction)
{
    // Twice what falls on surfaces: the sky that is seen is clear, the light from all around is what is left of it between things.
    const vec3 horizon = 0.7 * c.sky + 1.3 * vec3(dot(c.sky, vec3(0.4)));
    return direction.y >= 0.0 ? mix(horizon, 2.0 * c.sky, pow(direction.y, 0.45)) : mix(horizon, c.ground, min(1.0, pow(-direction.y, 0.35)));
}

void main()
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    if (r.background) {
        const vec3 p = world_from_depth(c.view, gl_FragCoord.xy, 0.5);
        radiance = vec4(background(-towards_eye(c.view, p)), 0.0);
        return;
    }
    vec3 color = texelFetch(albedo_image, pixel, 0).rgb * hemisphere(c.sky, c.ground, r.n_shading);
    if (c.emits != 0) color += texelFetch(emissive_image, pixel, 0).rgb;
    radiance = vec4(color, 1.0);
}
