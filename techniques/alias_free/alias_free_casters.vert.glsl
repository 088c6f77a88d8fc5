// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#include "shaders/scene.glsl"
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

// Triangles, pulled: each grown so that it covers the centre of every cell in which it may darken a sample.
layout(set = 0, binding = 0, scalar) readonly buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 3, scalar) readonly buffer Instances { Instance instances[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { GridConstants c; };

// Of the edge opposite to each corner: the plane through it and the light, and a point on it. Then the triangle's own plane.
layout(location = 0) flat out vec3 edge_normal[3];
layout(location = 3) flat out vec3 edge_point[3];
layout(location = 6) flat out vec3 plane_normal;
layout(location = 7) flat out uvec4 ids; // layer + 8 level, primitive, instance, triangle

#include "techniques/alias_free/alias_free_cover.glsl"

bool before(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// Both triangles at an edge must see the same plane through it and the light, but for its sign: they start from the same end.
void edge_plane(int k, vec3 from, vec3 to)
{
    const bool swapped = before(to, from);
    const vec3 a = swapped ? to : from, b = swapped ? from : to;
    precise const vec3 along = b - a;
    precise const vec3 ray = c.light.kind == LIGHT_DIRECTIONAL ? -c.light.direction : c.light.position - a;
    precise const vec3 n = vec3(ray.y * along.z - ray.z * along.y, ray.z * along.x - ray.x * along.z, ray.x * along.y - ray.y * along.x);
    edge_normal[k] = swapped ? -n : n;
    edge_point[k] = a;
}

void main()
{
    const uint code = uint(instance_layer(gl_InstanceIndex)), layer_index = code & 7u, level_index = code >> 3u;
    const uint slot = instance_slot(gl_InstanceIndex);
    const uint triangle = uint(gl_VertexIndex) / 3u, corner = uint(gl_VertexIndex) % 3u;
    gl_Layer = int(layer_index);
    gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
    edge_normal[0] = edge_normal[1] = edge_normal[2] = edge_point[0] = edge_point[1] = edge_point[2] = plane_normal = vec3(0.0);
    ids = uvec4(0);
    if (used[level_index * 8 + layer_index] == 0) return;

    const Instance i = instances[slot];
    vec3 p[3];
    for (uint k = 0; k < 3; ++k) p[k] = transform_point(i, positions[i.first_vertex + indices[i.first_index + 3 * triangle + k]]);
    edge_plane(0, p[1], p[2]);
    edge_plane(1, p[2], p[0]);
    edge_plane(2, p[0], p[1]);
    const vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const float side = dot(n, c.light.kind == LIGHT_DIRECTIONAL ? -c.light.direction : c.light.position - edge_point[0]);
    plane_normal = n * sign(side); // towards the light; 0 where the light's rays lie in the plane: they never cross it
    ids = uvec4(code, i.first_primitive + triangle, slot, triangle);
    if (side != 0.0) gl_Position = covering_vertex(c.map.layers[layer_index], level_index, p, abs(side) / length(n), corner);
}
