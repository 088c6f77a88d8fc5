// SPDX-License-Identifier: Apache-2.0
// How far a texel reaches in the picture: the twin of src/shadow/parts/texel_footprint.h, where it is derived.
#ifndef GNOMON_TEXEL_FOOTPRINT_GLSL
#define GNOMON_TEXEL_FOOTPRINT_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame.shared.h"
#include "shaders/light_map.glsl"

struct TexelFootprint {
    mat2 total; // column 0: a texel's edge along u, in pixels; column 1: along v
    mat2 perspective;
    float projection;
};

#define FOOTPRINT_LARGEST 1e9 // where the light grazes

// Towards the light at p: the direction along which the map's uv stay as they are.
vec3 map_ray(LightMapLayer layer, vec3 p_world)
{
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    const vec2 uv = h.xy / h.w;
    const vec3 ray = cross(gradient_of_uv(layer, 0, uv), gradient_of_uv(layer, 1, uv));
    return normalize(dot(ray, layer.depth_plane.xyz) > 0.0 ? -ray : ray);
}

// The inverse of texels per pixel.
mat2 pixels_per_texel(vec2 texels_x, vec2 texels_y)
{
    const float det = texels_x.x * texels_y.y - texels_x.y * texels_y.x;
    if (abs(det) < 1e-18) return mat2(FOOTPRINT_LARGEST);
    return mat2(texels_y.y, -texels_x.y, -texels_y.x, texels_x.x) / det;
}

TexelFootprint texel_footprint(View view, LightMapLayer layer, float size, vec3 p_world, vec3 n)
{
    const vec3 ray = view.orthographic != 0 ? view.forward : normalize(p_world - view.eye);
    const vec3 to_map = map_ray(layer, p_world);
    // A pixel's step across the view, at p's depth: the near plane's would drown in the eye's coordinates.
    const float w = (view.clip_from_world * vec4(p_world, 1.0)).w;
    const vec4 h = layer.map_from_world * vec4(p_world, 1.0);
    const float facing = dot(n, ray);
    vec2 on_surface[2], on_beam[2];
    for (int i = 0; i < 2; ++i) {
        const vec3 step_across = view.world_from_clip[i].xyz * (2.0 * w / view.size[i]);
        const vec3 surface = step_across - ray * (dot(n, step_across) / (abs(facing) < 1e-6 ? 1e-6 : facing));
        // across the eye's beam, then turned with the shortest rotation that takes -ray to to_map
        const vec3 beam = step_across - ray * dot(ray, step_across);
        const float both = 1.0 - dot(ray, to_map);
        const vec3 turned = both < 1e-6 ? beam : beam - (to_map - ray) * (dot(to_map, beam) / both);
        const vec4 a = layer.map_from_world * vec4(surface, 0.0), b = layer.map_from_world * vec4(turned, 0.0);
        on_surface[i] = (a.xy * h.w - h.xy * a.w) * (size / (h.w * h.w));
        on_beam[i] = (b.xy * h.w - h.xy * b.w) * (size / (h.w * h.w));
    }
    return TexelFootprint(pixels_per_texel(on_surface[0], on_surface[1]), pixels_per_texel(on_beam[0], on_beam[1]),
        min(abs(facing) / max(abs(dot(n, to_map)), 1e-9), FOOTPRINT_LARGEST));
}

float longer_edge(mat2 m) { return min(max(length(m[0]), length(m[1])), FOOTPRINT_LARGEST); }

#endif
