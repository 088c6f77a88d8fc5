// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/octahedral.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/gbuffer.shared.h"

layout(constant_id = 0) const bool masked = false;

layout(location = 0) in vec3 p_eye;
layout(location = 1) in vec3 n_world;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
layout(location = 4) flat in uvec2 ids; // first primitive, material

layout(set = 0, binding = 1, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GBufferConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

layout(location = 0) out uvec2 normal_out;
layout(location = 1) out uint primitive_out;
layout(location = 2) out vec4 albedo_out;
layout(location = 3) out vec4 surface_out;
layout(location = 4) out vec4 emissive_out;

void main()
{
    // A draw has one material. Said so, its fields are read once for all lanes: lavapipe otherwise gathers each word lane by lane.
    const uint material_index = subgroupBroadcastFirst(ids.y);
    const TextureUse base_use = materials[material_index].base_color_texture;
    vec4 base = materials[material_index].base_color * color;
    if (base_use.index >= 0) {
        const vec2 at = transform_uv(base_use, uv);
        const vec4 texel = texture(textures[base_use.index], at);
        base *= texel;
        if (masked) {
            // The cut-out is that of the finest level, as in ray-traced truth: coarser levels lose coverage.
            const float alpha = textureLod(textures[base_use.index], at, 0.0).a;
            if (alpha * materials[material_index].base_color.a * color.a < materials[material_index].alpha_cutoff) discard;
        }
    } else if (masked && base.a < materials[material_index].alpha_cutoff) {
        discard;
    }

    vec3 n_geometric = cross(dFdx(p_eye), dFdy(p_eye));
    n_geometric *= dot(n_geometric, p_eye) > 0.0 ? -1.0 : 1.0;
    vec3 n_shading = gl_FrontFacing ? n_world : -n_world;
    normal_out = uvec2(encode_normal(normalize(n_shading)), encode_normal(normalize(n_geometric)));
    primitive_out = ids.x + uint(gl_PrimitiveID);
    albedo_out = vec4(base.rgb, 1.0);

    vec2 rough_metal = vec2(materials[material_index].roughness, materials[material_index].metallic);
    const TextureUse surface_use = materials[material_index].metallic_roughness_texture;
    if (surface_use.index >= 0) rough_metal *= texture(textures[surface_use.index], transform_uv(surface_use, uv)).gb;
    surface_out = vec4(rough_metal.y, rough_metal.x, 0.0, 0.0);

    vec3 emissive = materials[material_index].emissive;
    const TextureUse emissive_use = materials[material_index].emissive_texture;
    if (emissive_use.index >= 0) emissive *= texture(textures[emissive_use.index], transform_uv(emissive_use, uv)).rgb;
    emissive_out = vec4(emissive, 0.0);
}
