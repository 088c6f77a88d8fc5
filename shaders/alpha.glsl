// SPDX-License-Identifier: Apache-2.0
// The alpha of a triangle's point, for ray tracing. Include after the blocks `instances`, `materials`, `indices`, `attributes`, `textures`.
#ifndef GNOMON_ALPHA_GLSL
#define GNOMON_ALPHA_GLSL

// Whether the material is there (alpha >= cutoff) at the barycentric point of triangle `triangle` of instance `slot`.
bool mask_keeps(uint slot, uint triangle, vec2 barycentric)
{
    const Instance i = instances[slot];
    const vec3 w = vec3(1.0 - barycentric.x - barycentric.y, barycentric);
    vec2 uv = vec2(0.0);
    float alpha = 0.0;
    for (uint k = 0; k < 3; ++k) {
        const VertexAttributes a = attributes[i.first_vertex + indices[i.first_index + 3 * triangle + k]];
        uv += w[k] * a.uv;
        alpha += w[k] * unpackUnorm4x8(a.color).a;
    }
    const TextureUse use = materials[i.material].base_color_texture;
    alpha *= materials[i.material].base_color.a;
    if (use.index >= 0) alpha *= textureLod(textures[nonuniformEXT(use.index)], transform_uv(use, uv), 0.0).a;
    return alpha >= materials[i.material].alpha_cutoff;
}

#endif
