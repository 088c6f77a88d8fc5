// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shaders/octahedral.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/gbuffer.shared.h"

layout(constant_id = 0) const bool masked = false;
layout(constant_id = 1) const bool material = true; // false: only what shadows need
layout(constant_id = 2) const bool flat_normals = false;

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

// The cut-out is that of the finest level, as in ray-traced truth: coarser levels lose coverage.
bool kept(uint index)
{
    const TextureUse use = materials[index].base_color_texture;
    float alpha = materials[index].base_color.a * color.a;
    if (use.index >= 0) alpha *= textureLod(textures[use.index], transform_uv(use, uv), 0.0).a;
    return alpha >= materials[index].alpha_cutoff;
}

vec4 sample_use(TextureUse use) { return use.index >= 0 ? texture(textures[use.index], transform_uv(use, uv)) : vec4(1.0); }

void main()
{
    // A draw has one material. Said so, its fields are read once for all lanes: lavapipe otherwise gathers each word lane by lane.
    const uint index = subgroupBroadcastFirst(ids.y);
    // before any discard: derivatives need their neighbours
    vec3 n_geometric = cross(dFdx(p_eye), dFdy(p_eye));
    vec4 base = vec4(1.0), surface = vec4(1.0), emissive = vec4(1.0);
    if (material) {
        base = sample_use(materials[index].base_color_texture);
        surface = sample_use(materials[index].metallic_roughness_texture);
        emissive = sample_use(materials[index].emissive_texture);
    }
    if (masked && !kept(index)) discard;

    n_geometric *= dot(n_geometric, c.view.orthographic != 0 ? c.view.forward : p_eye) > 0.0 ? -1.0 : 1.0;
    const vec3 n_shading = flat_normals ? n_geometric : gl_FrontFacing ? n_world : -n_world;
    normal_out = uvec2(encode_normal(n_shading), encode_normal(n_geometric));
    primitive_out = ids.x + uint(gl_PrimitiveID);
    albedo_out = vec4(base.rgb * materials[index].base_color.rgb * color.rgb, 1.0);
    surface_out = vec4(surface.b * materials[index].metallic, surface.g * materials[index].roughness, 0.0, 0.0);
    emissive_out = vec4(emissive.rgb * materials[index].emissive, 0.0);
}
