// SPDX-License-Identifier: Apache-2.0
// A caster's corners, and the planes that decide what lies behind it.
#ifndef GNOMON_ALIAS_FREE_TRIANGLE_GLSL
#define GNOMON_ALIAS_FREE_TRIANGLE_GLSL

bool before(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

// Both triangles at an edge must see the same plane through it and the light, but for its sign: they start from the same end.
void edge_plane(vec3 from, vec3 to, out vec3 normal, out vec3 point)
{
    const bool swapped = before(to, from);
    point = swapped ? to : from;
    precise const vec3 along = (swapped ? from : to) - point;
    precise const vec3 ray = c.light.kind == LIGHT_DIRECTIONAL ? -c.light.direction : c.light.position - point;
    precise const vec3 n = vec3(ray.y * along.z - ray.z * along.y, ray.z * along.x - ray.x * along.z, ray.x * along.y - ray.y * along.x);
    normal = swapped ? -n : n;
}

vec3 corner_of(Instance i, uint triangle, uint k)
{
    return transform_point(i, positions[i.first_vertex + indices[i.first_index + 3 * triangle + k]]);
}

// The triangle's normal, not of unit length, towards the light, which is `height` above it; 0 where the light lies in its plane.
vec3 light_side(vec3 p[3], out float height)
{
    const vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const float side = dot(n, c.light.kind == LIGHT_DIRECTIONAL ? -c.light.direction : c.light.position - p[0]);
    height = side == 0.0 ? 0.0 : abs(side) / length(n);
    return n * sign(side);
}

#endif
