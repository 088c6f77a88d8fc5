// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/brdf.glsl"
#include "shaders/emission.glsl"
#include "shaders/receiver.glsl"
#include "src/shadow/lighting.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D albedo_image;
layout(set = 0, binding = 3) uniform sampler2D surface_image;
layout(set = 0, binding = 4) uniform sampler2D shadow_image;
layout(set = 1, binding = 0, scalar) uniform Constants { LightingConstants c; };

layout(location = 0) out vec4 radiance;

void main()
{
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const Receiver r = load_receiver(c.view, depth_image, normal_image, gl_FragCoord.xy);
    radiance = vec4(0.0);
    if (r.background) return;
    vec3 shadow = vec3(1.0);
    if (c.shadowed != 0) {
        const vec4 s = texelFetch(shadow_image, pixel, 0);
        shadow = c.colored != 0 ? s.rgb : s.rrr;
        if (all(equal(shadow, vec3(0.0)))) return;
    }
    const vec4 l = to_light(c.light, r.p_world);
    const vec2 metal_rough = texelFetch(surface_image, pixel, 0).rg;
    const Surface surface = Surface(texelFetch(albedo_image, pixel, 0).rgb, metal_rough.x, metal_rough.y);
    radiance = vec4(reflect_light(surface, r.n_shading, l.xyz, towards_eye(c.view, r.p_world)) * irradiance(c.light, l) * shadow, 0.0);
}
