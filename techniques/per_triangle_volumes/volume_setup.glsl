// SPDX-License-Identifier: Apache-2.0
// Planes of the volume behind a triangle. They are spanned in world axes, from differences of positions, and relative to the eye, which
// keeps digits that products of clip coordinates lose; the last step takes them to normalised device coordinates (a generalised cross
// product in clip space gives the same planes but for a common positive factor). Include after `c`, the VolumeConstants.
#ifndef GNOMON_VOLUME_SETUP_GLSL
#define GNOMON_VOLUME_SETUP_GLSL
#include "techniques/per_triangle_volumes/volume.glsl"

// Lines only spare tests and do not share bits with the sides.
const float LINE_SLACK = 1e-6;

bool before(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

vec3 exact_cross(vec3 a, vec3 b)
{
    precise const vec3 n = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return n;
}

float exact_dot(vec3 a, vec3 b)
{
    precise const float d = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return d;
}

vec3 from_point_to_light(vec3 p)
{
    precise const vec3 d = c.light.kind == LIGHT_DIRECTIONAL ? -c.light.direction : c.light.position - p;
    return d;
}

// The plane with normal n through a point, over normalised device coordinates.
vec4 ndc_plane(vec3 n, vec3 through)
{
    precise const vec3 from = c.eye - through;
    const float k = exact_dot(n, from);
    const mat4 m = c.world_from_ndc;
    precise const vec4 plane = vec4((exact_dot(n, m[0].xyz) + k * m[0].w), (exact_dot(n, m[1].xyz) + k * m[1].w),
        (exact_dot(n, m[2].xyz) + k * m[2].w), (exact_dot(n, m[3].xyz) + k * m[3].w));
    return plane;
}

// From the lesser end to the greater: both triangles at an edge get the same bits.
vec4 edge_plane(vec3 a, vec3 b)
{
    precise const vec3 along = b - a;
    return ndc_plane(exact_cross(from_point_to_light(a), along), a);
}

// The picture's line through the light and a corner, turned so that the whole volume lies on its positive side, or vec3(0) where it does
// not lie on one. It is the plane through the eye, the light and the corner; `eye` is where c.eye_point stands.
vec3 bounding_line(vec3 corner, vec3 other_0, vec3 other_1)
{
    // Homogeneous and relative to the eye: of an orthographic view that is a direction.
    const bool directional = c.light.kind == LIGHT_DIRECTIONAL;
    const vec3 light = directional ? -c.light.direction : c.light.position - c.eye, v = corner - c.eye;
    const bool orthographic = c.eye_point.w == 0.0;
    const vec3 a = orthographic ? c.eye_point.xyz : light, b = orthographic ? (directional ? light : light - v) : v;
    const vec3 n = cross(a, b), away = orthographic ? v : vec3(0.0);
    const vec2 e = vec2(dot(n, other_0 - c.eye - away), dot(n, other_1 - c.eye - away));
    const float size = length(a) * (length(b) + (orthographic && !directional ? length(light) + length(v) : 0.0));
    const vec2 doubt = LINE_SLACK * size * vec2(length(other_0 - c.eye) + length(away), length(other_1 - c.eye) + length(away));
    const float side = all(greaterThan(e, doubt)) ? 1.0 : all(lessThan(e, -doubt)) ? -1.0 : 0.0;
    const mat4 m = c.world_from_ndc;
    const float k = -dot(n, away);
    const vec3 line = side * vec3(dot(n, m[0].xyz) + k * m[0].w, dot(n, m[1].xyz) + k * m[1].w, dot(n, m[3].xyz) + k * m[3].w);
    return line + vec3(0.0, 0.0, LINE_SLACK * size * (c.ray + (orthographic ? length(v) : 0.0)));
}

bool finite(vec4 v) { return !any(isnan(v)) && !any(isinf(v)); }

// A triangle in the order of its corners' positions, and where they stood.
struct Sorted {
    vec3 a, b, d;
    uvec3 from;
};

Sorted sorted(vec3 a, vec3 b, vec3 d)
{
    Sorted s = Sorted(a, b, d, uvec3(0, 1, 2));
    if (before(s.b, s.a)) s = Sorted(s.b, s.a, s.d, s.from.yxz);
    if (before(s.d, s.b)) s = Sorted(s.a, s.d, s.b, s.from.xzy);
    if (before(s.b, s.a)) s = Sorted(s.b, s.a, s.d, s.from.yxz);
    return s;
}

vec4 pick(uvec3 from, uint corner, vec4 a, vec4 b, vec4 d) { return from.x == corner ? a : from.y == corner ? b : d; }

// `height`: the light's over the triangle's plane, times twice its area; positive where the light sees the sorted corners counterclockwise.
// `doubt`: what rounding may have made of 0.
float light_height(Sorted s, out vec3 n, out float doubt)
{
    precise const vec3 u = s.b - s.a, v = s.d - s.a;
    const vec3 to_light = from_point_to_light(s.a);
    n = exact_cross(u, v);
    doubt = 1e-6 * length(u) * length(v) * length(to_light);
    return exact_dot(n, to_light);
}

// `height`: light_height. `turn`: 1 or -1, its sign, as far as it is known.
Volume make_volume(Sorted s, vec3 n, float height, float turn)
{
    Volume v;
    const vec4 opposite_a = turn * edge_plane(s.b, s.d), opposite_b = -turn * edge_plane(s.a, s.d), opposite_d = turn * edge_plane(s.a, s.b);
    v.side_0 = pick(s.from, 0, opposite_a, opposite_b, opposite_d);
    v.side_1 = pick(s.from, 1, opposite_a, opposite_b, opposite_d);
    v.side_2 = pick(s.from, 2, opposite_a, opposite_b, opposite_d);
    v.cap = -sign(height) * ndc_plane(n, s.a);
    // The planes that were negated leave themselves to the neighbour.
    const uvec3 open = turn > 0.0 ? uvec3(0, 1, 0) : uvec3(1, 0, 1);
    v.slot = (open.x << s.from.x | open.y << s.from.y | open.z << s.from.z) * VOLUME_OPEN;
    // Two of the three lines bound the volume, unless the light shines from within its picture.
    const vec3 line_a = bounding_line(s.a, s.b, s.d), line_b = bounding_line(s.b, s.a, s.d), line_d = bounding_line(s.d, s.a, s.b);
    v.line_0 = any(notEqual(line_a.xy, vec2(0.0))) ? line_a : line_b;
    v.line_1 = any(notEqual(line_d.xy, vec2(0.0))) ? line_d : line_b;
    v.primitive = 0;
    return v;
}

#endif
