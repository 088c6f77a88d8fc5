// SPDX-License-Identifier: Apache-2.0
// The scene's buffers as shadow::SceneGpu lays them out.
#ifndef GNOMON_SCENE_GLSL
#define GNOMON_SCENE_GLSL
#extension GL_EXT_scalar_block_layout : require

struct Instance {
    vec4 row_x, row_y, row_z; // world_from_object, 3x4
    uint first_primitive; // scene-wide id of its triangle 0
    uint material;
    uint first_index; // of its mesh in the index buffer
    uint first_vertex;
};

struct VertexAttributes {
    uint normal; // octahedral, snorm16x2
    vec2 uv;
    uint color; // rgba8
};

struct TextureUse {
    int index; // -1 = none
    vec3 u_row, v_row; // KHR_texture_transform
};

#define MATERIAL_DOUBLE_SIDED 1u
#define MATERIAL_MASK 2u
#define MATERIAL_BLEND 4u

struct Material {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    float roughness;
    float alpha_cutoff;
    uint flags; // MATERIAL_*
    float transmission;
    vec3 volume_tint; // attenuation_color^(thickness / attenuation_distance)
    TextureUse base_color_texture, metallic_roughness_texture, emissive_texture;
};

// gl_InstanceIndex carries a layer in its top byte (SceneGpu::DrawOptions::layer), so that one draw can aim at one layer without a
// constant of its own.
uint instance_slot(int instance_index) { return uint(instance_index) & 0xffffffu; }
int instance_layer(int instance_index) { return int(uint(instance_index) >> 24); }

vec3 transform_point(Instance i, vec3 p) { return vec3(dot(i.row_x, vec4(p, 1.0)), dot(i.row_y, vec4(p, 1.0)), dot(i.row_z, vec4(p, 1.0))); }

// Normals go by the cofactor matrix (the inverse transpose up to a positive scale; the determinant is positive).
vec3 transform_normal(Instance i, vec3 n)
{
    const vec3 x = i.row_x.xyz, y = i.row_y.xyz, z = i.row_z.xyz;
    return vec3(dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n));
}

vec2 transform_uv(TextureUse use, vec2 uv) { return vec2(dot(use.u_row, vec3(uv, 1.0)), dot(use.v_row, vec3(uv, 1.0))); }

#endif
