// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "shaders/scene.glsl"
#include "src/shadow/parts/ordered_float.glsl"
#include "src/shadow/parts/volume_band.glsl"
#include "src/shadow/parts/volume_mask.shared.h"

// Marks where from the light the receivers are that are seen and may be lit.
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, scalar) buffer Mask { uint everywhere; VolumeTexel texels[]; };
layout(set = 0, binding = 3) uniform usampler2DArray triangle_image; // slot and triangle that the light sees
layout(set = 0, binding = 4, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 6, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 7) uniform sampler2D decided_image;
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeMaskConstants c; };

layout(constant_id = 1) const bool some = false; // receivers count only where decided_image is negative
layout(constant_id = 0) const bool shadowed = true; // whether receivers that are proven dark reach no further than what darkens them

// Metres by which what is drawn of a volume may differ from the volume: a rasteriser's snapping of vertices (1/256 pixel) and the depth
// of a polygon that runs to infinity, with room to spare.
float drawing_error(Receiver r) { return 0.1 * pixel_metres(c.view, r.p_world) + 4.0 * position_rounding(c.view, r); }

vec3 corner(Instance i, uint triangle, uint k) { return transform_point(i, positions[i.first_vertex + indices[i.first_index + 3u * triangle + k]]); }

// How far on the inner side of the plane through the light and an edge p lies; `side`: of the triangle's normal, as the light sees it.
float inside_edge(vec3 p, vec3 from, vec3 to, vec4 light, float side)
{
    const vec3 n = cross(light.xyz - light.w * from, to - from);
    return side * dot(n, p - from) / max(length(n), 1e-30);
}

// The depth of the triangle that the light sees in the receiver's place where the receiver lies behind it by more than drawing may miss;
// else the receiver's own. Whatever comes later to the receiver changes nothing there: it is dark already.
float reach_of(Receiver r, LightMapLayer layer, int index, MapPoint m)
{
    if (!shadowed) return m.depth;
    const ivec2 texel = min(ivec2(m.uv * c.map.size), ivec2(c.map.size) - 1);
    const uvec2 id = texelFetch(triangle_image, ivec3(texel, index), 0).rg;
    if (id.x == 0xffffffffu) return m.depth;
    const Instance i = instances[id.x];
    const vec3 a = corner(i, id.y, 0), b = corner(i, id.y, 1), d = corner(i, id.y, 2);
    const vec4 light = c.light.kind == LIGHT_DIRECTIONAL ? vec4(-c.light.direction, 0.0) : vec4(c.light.position, 1.0);
    const vec3 n = cross(b - a, d - a), p = r.p_world;
    const float height = dot(n, light.xyz - light.w * a), side = sign(height), error = drawing_error(r);
    const float below = -side * dot(n, p - a);
    const float inner = min(inside_edge(p, a, b, light, side), min(inside_edge(p, b, d, light, side), inside_edge(p, d, a, light, side)));
    if (!(inner > error && below > error * length(n))) return m.depth;
    const vec3 towards = light.xyz - light.w * p;
    const vec3 hit = p + towards * (below / abs(dot(n, towards)));
    return min(m.depth, dot(layer.depth_plane, vec4(hit, 1.0)));
}

void main()
{
    if (some && texelFetch(decided_image, ivec2(gl_FragCoord.xy), 0).r >= 0.0) return;
    Receiver r;
    float decided;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, decided)) return;
    const uint band = 1u << band_of(uvec2(gl_FragCoord.xy), c.view.size, c.axis, c.bands);
    const int index = select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, r.p_world);
    const LightMapLayer layer = c.map.layers[index];
    const MapPoint m = project(layer, r.p_world);
    if (!m.inside) { // layers hold all that is seen; should rounding put a receiver beside them, nothing is culled in its band
        atomicOr(everywhere, band);
        return;
    }
    const ivec2 at = min(ivec2(m.uv * float(VOLUME_MASK_SIZE)), ivec2(VOLUME_MASK_SIZE - 1));
    const int i = (index * VOLUME_MASK_SIZE + at.y) * VOLUME_MASK_SIZE + at.x;
    const uint reach = ordered_from_float(reach_of(r, layer, index, m));
    // as they were some time ago, which is enough
    if (texels[i].reach < reach) atomicMax(texels[i].reach, reach);
    if ((texels[i].bands & band) == 0u) atomicOr(texels[i].bands, band);
}
