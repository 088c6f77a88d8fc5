// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_ARB_shader_viewport_layer_array : require
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free_bindings.glsl"
#include "techniques/alias_free/alias_free_triangle.glsl"
#include "techniques/alias_free/alias_free_cover.glsl"

// Casters of many cells, each grown so that it covers the centre of every cell in which it may darken a sample.
layout(set = 0, binding = 8, scalar) readonly buffer Wide { WideCaster wide[]; };

layout(location = 0) flat out vec3 edge_normal[3];
layout(location = 3) flat out vec3 edge_point[3];
layout(location = 6) flat out vec3 plane_normal;
layout(location = 7) flat out uvec4 ids; // layer + 8 level, slot, triangle, masked

void main()
{
    const uint index = uint(gl_VertexIndex) / 3u, corner = uint(gl_VertexIndex) % 3u;
    gl_Layer = 0;
    gl_Position = nowhere;
    edge_normal[0] = edge_normal[1] = edge_normal[2] = edge_point[0] = edge_point[1] = edge_point[2] = plane_normal = vec3(0.0);
    ids = uvec4(0);
    if (index >= c.wide) return;
    const WideCaster t = wide[index];
    const Instance i = instances[t.slot];
    const vec3 p[3] = vec3[](corner_of(i, t.triangle, 0), corner_of(i, t.triangle, 1), corner_of(i, t.triangle, 2));
    edge_plane(p[1], p[2], edge_normal[0], edge_point[0]);
    edge_plane(p[2], p[0], edge_normal[1], edge_point[1]);
    edge_plane(p[0], p[1], edge_normal[2], edge_point[2]);
    float height;
    plane_normal = light_side(p, height);
    ids = uvec4(t.place, t.slot, t.triangle, t.masked);
    gl_Layer = int(t.place & 7u);
    gl_Position = covering_vertex(c.map.layers[t.place & 7u], c.grid.level[t.place >> 3u], p, height, corner);
}
