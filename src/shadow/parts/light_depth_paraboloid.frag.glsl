// SPDX-License-Identifier: Apache-2.0
// One texel's ray against one triangle (Gascuel, Holzschuch, Fournier, Peroche 2008, "Fast non-linear projections using graphics hardware").
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "shaders/scene.glsl"
#include "src/shadow/parts/light_depth_paraboloid.shared.h"

layout(location = 0) flat in vec3 p_light[3];
layout(location = 3) flat in vec3 uv_alpha[3];
layout(location = 6) flat in uint material;
layout(set = 0, binding = 1, scalar) readonly buffer Materials { Material materials[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { ParaboloidConstants c; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

bool is_there(vec3 weights)
{
    if ((materials[material].flags & MATERIAL_MASK) == 0) return true;
    const vec3 at = mat3(uv_alpha[0], uv_alpha[1], uv_alpha[2]) * weights;
    const TextureUse use = materials[material].base_color_texture;
    float alpha = materials[material].base_color.a * at.z;
    if (use.index >= 0) alpha *= textureLod(textures[nonuniformEXT(use.index)], transform_uv(use, at.xy), 0.0).a;
    return alpha >= materials[material].alpha_cutoff;
}

void main()
{
    // the inverse of the projection xy / (|p| + z)
    const vec2 q = (gl_FragCoord.xy / c.size - 0.5) / c.map_from_world[0][3][3];
    const vec3 d = vec3(2.0 * q, 1.0 - dot(q, q)) / (1.0 + dot(q, q));
    // volumes of the ray with the edges: all of one sign inside the triangle, and its barycentric weights
    const vec3 bc = cross(p_light[1], p_light[2]);
    const vec3 w = vec3(dot(bc, d), dot(cross(p_light[2], p_light[0]), d), dot(cross(p_light[0], p_light[1]), d));
    const float volume = dot(p_light[0], bc), sum = w.x + w.y + w.z;
    const float distance = volume / sum;
    const float z = c.near / (c.far - c.near) * (c.far / max(distance, 1e-20) - 1.0);
    const float bias = c.slope_bias * max(abs(dFdx(z)), abs(dFdy(z)));
    const bool inside = volume < 0.0 ? all(lessThanEqual(w, vec3(0.0))) : all(greaterThanEqual(w, vec3(0.0)));
    const bool culled = c.cull == 1 ? volume > 0.0 : c.cull == 2 && volume < 0.0; // corners run counter-clockwise on front faces
    if (!inside || culled || sum == 0.0 || distance < c.near || !is_there(w / sum)) discard;
    gl_FragDepth = clamp(z - bias, 0.0, 1.0);
}
