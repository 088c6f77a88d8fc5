// SPDX-License-Identifier: Apache-2.0
// Casters for dual-paraboloid layers. Straight edges become arcs there, so a triangle is not drawn through its projected corners, which is wrong
// by the arc's bulge: six vertices draw the box around its true outline, and fragments intersect their own ray with the triangle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "src/shadow/parts/light_depth_paraboloid.shared.h"

layout(set = 0, binding = 0, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Attributes { VertexAttributes attributes[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { ParaboloidConstants c; };

layout(location = 0) flat out vec3 p_light[3]; // corners: u, v and depth from the light, metres
layout(location = 3) flat out vec3 uv_alpha[3];
layout(location = 6) flat out uint material;

// The box around the images of the triangle's edges, grown.
vec4 add_point(vec4 box, vec2 q) { return vec4(min(box.xy, q), max(box.zw, q)); }

// A plane through the light, of normal m, is drawn as a circle around m.xy / m.z of radius 1 / |m.z|: the projection is stereographic. Where the
// arc from a to b passes one of the circle's four extreme points, the box holds it.
vec4 add_arc(vec4 box, vec3 a, vec3 b)
{
    const vec3 m = cross(a, b) / max(length(cross(a, b)), 1e-30);
    if (abs(m.z) < 1e-6) return box; // a straight line
    for (int k = 0; k < 4; ++k) {
        const vec2 side = k < 2 ? vec2(1.0 - 2.0 * float(k), 0.0) : vec2(0.0, 5.0 - 2.0 * float(k));
        const vec2 q = m.xy / m.z + side / abs(m.z);
        const vec3 d = vec3(2.0 * q, 1.0 - dot(q, q));
        if (dot(cross(a, d), m) >= 0.0 && dot(cross(d, b), m) >= 0.0) box = add_point(box, q);
    }
    return box;
}

void main()
{
    const Instance i = instances[instance_slot(gl_InstanceIndex)];
    const int layer = gl_Layer = instance_layer(gl_InstanceIndex);
    const uint triangle = uint(gl_VertexIndex) / 6u, corner = uint(gl_VertexIndex) % 6u;
    const mat4 m = c.map_from_world[layer];
    const float scale = m[3][3];
    material = i.material;
    vec4 box = vec4(1e30, 1e30, -1e30, -1e30);
    // The square's corners look back by this cosine: what lies wholly behind the cone is not drawn.
    const float reach = 0.5 / (scale * scale), back = (1.0 - reach) / (1.0 + reach);
    bool behind = true, singular = false;
    for (uint k = 0; k < 3; ++k) {
        const uint v = i.first_vertex + indices[i.first_index + 3 * triangle + k];
        const vec4 h = m * vec4(transform_point(i, positions[v]), 1.0);
        p_light[k] = vec3(h.xy / scale, h.z);
        uv_alpha[k] = vec3(attributes[v].uv, unpackUnorm4x8(attributes[v].color).a);
        const float distance = length(p_light[k]), ahead = distance + p_light[k].z;
        behind = behind && p_light[k].z < min(back, -0.01) * distance;
        singular = singular || ahead < 1e-3 * distance;
        box = add_point(box, p_light[k].xy / max(ahead, 1e-30));
    }
    const vec3 ab = cross(p_light[0], p_light[1]), bc = cross(p_light[1], p_light[2]), ca = cross(p_light[2], p_light[0]);
    // a triangle around the axis behind the light has an outline, but lies outside of it
    const vec3 at_pole = -vec3(ab.z, bc.z, ca.z) * (dot(p_light[0], bc) < 0.0 ? -1.0 : 1.0);
    singular = singular || all(greaterThanEqual(at_pole, vec3(0.0)));
    for (int k = 0; k < 3; ++k) box = add_arc(box, p_light[k], p_light[(k + 1) % 3]);
    // clip coordinates, with a texel to spare
    box = box * (2.0 * scale) + vec4(-1.0, -1.0, 1.0, 1.0) * (2.0 / c.size);
    if (singular) box = vec4(-1.0, -1.0, 1.0, 1.0);
    box = clamp(box, -1.0, 1.0);
    const bool right = corner == 1u || corner == 4u || corner == 5u, below = corner == 2u || corner == 3u || corner == 5u;
    gl_Position = behind ? vec4(0.0, 0.0, 0.0, -1.0) : vec4(right ? box.z : box.x, below ? box.w : box.y, 0.5, 1.0);
}
