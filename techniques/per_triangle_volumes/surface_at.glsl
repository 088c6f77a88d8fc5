// SPDX-License-Identifier: Apache-2.0
// The material of a point of a triangle. Include after the blocks `instances`, `indices`, `materials`, `attributes`, `textures`, and `c`.
#ifndef GNOMON_SURFACE_AT_GLSL
#define GNOMON_SURFACE_AT_GLSL

struct Corners {
    vec2 uv_0, uv_1, uv_2;
    vec4 color_0, color_1, color_2;
    uint material;
};

Corners corners_of(Volume v)
{
    const Instance i = instances[v.slot >> 4];
    const uint first = i.first_index + 3 * (v.primitive - i.first_primitive);
    const VertexAttributes a_0 = attributes[i.first_vertex + indices[first]], a_1 = attributes[i.first_vertex + indices[first + 1]],
                           a_2 = attributes[i.first_vertex + indices[first + 2]];
    return Corners(a_0.uv, a_1.uv, a_2.uv, unpackUnorm4x8(a_0.color), unpackUnorm4x8(a_1.color), unpackUnorm4x8(a_2.color), i.material);
}

float longest(vec2 a, vec2 b) { return sqrt(max(dot(a, a), dot(b, b))); }

// What is the same at all corners keeps its bits, as a sum of three weighted ones would not.
vec2 between(vec2 a_0, vec2 a_1, vec2 a_2, vec3 at) { return a_0 + at.y * (a_1 - a_0) + at.z * (a_2 - a_0); }
vec4 between(vec4 a_0, vec4 a_1, vec4 a_2, vec3 at) { return a_0 + at.y * (a_1 - a_0) + at.z * (a_2 - a_0); }

// At barycentric coordinates `at`, which change by `right` and `down` over the width that a texture is to be averaged over.
vec3 transmittance_of(Corners k, vec3 at, vec3 right, vec3 down)
{
    const Material m = materials[k.material];
    vec4 base = m.base_color * between(k.color_0, k.color_1, k.color_2, at);
    const TextureUse use = m.base_color_texture;
    if (use.index >= 0) {
        const vec2 size = vec2(textureSize(textures[nonuniformEXT(use.index)], 0)), uv = transform_uv(use, between(k.uv_0, k.uv_1, k.uv_2, at));
        const vec2 to_right = transform_uv(use, between(k.uv_0, k.uv_1, k.uv_2, at + right)) - uv;
        const vec2 to_down = transform_uv(use, between(k.uv_0, k.uv_1, k.uv_2, at + down)) - uv;
        const float texels = longest(size * to_right, size * to_down);
        // A cutoff is meant for the finest level.
        const bool finest = c.texture_level == LEVEL_FINEST || (m.flags & MATERIAL_MASK) != 0;
        base *= textureLod(textures[nonuniformEXT(use.index)], uv, finest ? 0.0 : log2(max(texels, 1.0)));
    }
    return transmittance(m, base);
}

// Where the ray from a sample to the light crosses the triangle. `e` are the values of its sides there, which are the barycentric coordinates
// but for their sum. Their planes are linear in the picture: a pixel to the right at the same depth they grow by known amounts, and so
// follows by how much the crossing moves. This is the footprint of a disk across the view; a receiver that the eye sees at a slant has a
// longer one, which would blur across it as well.
vec3 transmittance_at(Volume v, vec3 e)
{
    const float sum = e.x + e.y + e.z;
    const vec3 at = e / sum;
    // from one pixel to the next, not sample: the mean of a pixel's samples is as wide as that
    const vec2 pixel = 2.0 * c.tree.step * exp2(vec2(c.side_log2));
    const vec3 right = vec3(v.side_0.x, v.side_1.x, v.side_2.x) * pixel.x, down = vec3(v.side_0.y, v.side_1.y, v.side_2.y) * pixel.y;
    return transmittance_of(
        corners_of(v), at, (right - at * (right.x + right.y + right.z)) / sum, (down - at * (down.x + down.y + down.z)) / sum);
}

// The texture's mean over the triangle, or about it: its middle, in the level where one texel is as large.
vec3 mean_transmittance(Volume v) { return transmittance_of(corners_of(v), vec3(1.0 / 3.0), vec3(-1.0, 1.0, 0.0), vec3(-1.0, 0.0, 1.0)); }

#endif
