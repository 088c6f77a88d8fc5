// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/emission.glsl"
#include "shaders/receiver.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/lighting.shared.h"

layout(location = 0) in vec3 p_world;
layout(location = 1) in vec3 n_world;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
layout(location = 4) flat in uint material;

layout(set = 0, binding = 1, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { BlendedConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

layout(location = 0) out vec4 radiance; // premultiplied

void main()
{
    const TextureUse use = materials[material].base_color_texture;
    vec4 base = materials[material].base_color * color;
    if (use.index >= 0) base *= texture(textures[nonuniformEXT(use.index)], transform_uv(use, uv));
    const vec3 n = normalize(gl_FrontFacing ? n_world : -n_world);
    vec3 light = hemisphere(c.sky, c.ground, n);
    // A thin sheet passes on half of what falls on either side; Lambert.
    for (uint i = 0; i < c.light_count; ++i) {
        const vec4 l = to_light(c.lights[i], p_world);
        light += irradiance(c.lights[i], l) * abs(dot(n, l.xyz)) * (0.5 / 3.14159265);
    }
    radiance = vec4((base.rgb * light + materials[material].emissive) * base.a, base.a);
}
