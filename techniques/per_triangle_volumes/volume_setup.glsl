// SPDX-License-Identifier: Apache-2.0
// Planes of the volume behind a triangle. They are spanned in world axes, from differences of positions, and relative to the eye, which
// keeps digits that products of clip coordinates lose; the last step takes them to normalised device coordinates (a generalised cross
// product in clip space gives the same planes but for a common positive factor). Include after `c`, the VolumeConstants.
#ifndef GNOMON_VOLUME_SETUP_GLSL
#define GNOMON_VOLUME_SETUP_GLSL
#include "techniques/per_triangle_volumes/volume.glsl"

// Of the size of a line's terms. Lines only spare tests and do not share bits with the sides.
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

// A homogeneous point, relative to the eye, as a line through it and the eye needs it: what counts is the plane through both and the eye.
struct Seen {
    vec3 p;
    float w;
    float size; // of its terms
};

Seen seen_corner(vec3 corner) { return Seen(corner - c.eye, 1.0, length(corner - c.eye)); }

Seen seen_light()
{
    if (c.light.kind == LIGHT_DIRECTIONAL) return Seen(-c.light.direction, 0.0, 1.0);
    return seen_corner(c.light.position);
}

// A line in the picture through two points, as a plane with normal n and offset k in the world. `doubt`: what rounding may make of it.
struct Line {
    vec3 n;
    float k, doubt;
};

Line line_through(Seen a, Seen b)
{
    // The plane holds the eye: the point 0 or, of an orthographic view, the direction in which it looks.
    if (c.eye_point.w != 0.0) return Line(cross(a.p, b.p), 0.0, LINE_SLACK * a.size * b.size);
    const vec3 along = a.w * b.p - b.w * a.p, n = cross(c.eye_point.xyz, along), through = a.w != 0.0 ? a.p : b.p;
    const float size = abs(a.w) * b.size + abs(b.w) * a.size;
    return Line(n, -dot(n, through), LINE_SLACK * size * (1.0 + (a.w != 0.0 ? a.size : b.size)));
}

// 1 or -1: the side of the line on which a point certainly lies, or 0.
float side_of(Line l, Seen s)
{
    const float e = dot(l.n, s.p) + l.k * s.w, doubt = l.doubt * (s.size + s.w);
    return abs(e) > doubt ? sign(e) : 0.0;
}

// Where all of the volume lies on one side of the line: positive there, by a margin for rounding. Else vec3(0.0).
vec3 bound(Line l, float side)
{
    const mat4 m = c.world_from_ndc;
    const vec3 line = vec3(dot(l.n, m[0].xyz) + l.k * m[0].w, dot(l.n, m[1].xyz) + l.k * m[1].w, dot(l.n, m[3].xyz) + l.k * m[3].w);
    return side == 0.0 ? vec3(0.0) : side * line + vec3(0.0, 0.0, l.doubt * (c.ray + 1.0));
}

// Points of the volume are Y + t (Y - L) for Y in the triangle and t >= 0: on the same side of a line as all Y where L lies on it (through a
// corner and the light) or opposite (the edges towards the light).
vec3 line_of_corner(Seen light, Seen corner, Seen other_0, Seen other_1)
{
    const Line l = line_through(light, corner);
    const float side = side_of(l, other_0);
    return bound(l, side == side_of(l, other_1) ? side : 0.0);
}

vec3 line_of_edge(Seen light, Seen from, Seen to, Seen opposite)
{
    const Line l = line_through(from, to);
    const float side = side_of(l, opposite);
    return bound(l, side == -side_of(l, light) ? side : 0.0);
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

// At most two lines of either kind bound the volume; none do where the light shines from within its picture.
void find_lines(Sorted s, inout Volume v)
{
    const Seen light = seen_light(), a = seen_corner(s.a), b = seen_corner(s.b), d = seen_corner(s.d);
    const vec3 of_a = line_of_corner(light, a, b, d), of_b = line_of_corner(light, b, a, d), of_d = line_of_corner(light, d, a, b);
    v.line_0 = of_a == vec3(0.0) ? of_b : of_a;
    v.line_1 = of_d == vec3(0.0) ? of_b : of_d;
    const vec3 of_ab = line_of_edge(light, a, b, d), of_bd = line_of_edge(light, b, d, a), of_ad = line_of_edge(light, a, d, b);
    v.line_2 = of_ab == vec3(0.0) ? of_bd : of_ab;
    v.line_3 = of_ad == vec3(0.0) ? of_bd : of_ad;
}

// Surfaces seen at a slant are drawn off their planes by more than a move towards the eye makes good, and walls may be modelled twice: a
// triangle begins to cast as much further on along the light's ray as samples are moved. Those that the ray hardly crosses get next to no
// bias, for one of theirs opens cracks.
vec4 cap_bias(float height, vec3 to_light)
{
    precise const float slant = abs(height) / sqrt(exact_dot(to_light, to_light));
    const vec3 z = c.world_from_ndc[2].xyz;
    precise const float constant = TREE.nearer.y + TREE.nearer.x * sqrt(exact_dot(z, z));
    precise const vec4 bias = vec4(0.0, 0.0, slant * TREE.nearer.z, slant * constant);
    return bias;
}

// `height`: light_height. `turn`: 1 or -1, its sign, as far as it is known.
Volume make_volume(Sorted s, vec3 n, float height, float turn)
{
    Volume v;
    const vec4 opposite_a = turn * edge_plane(s.b, s.d), opposite_b = -turn * edge_plane(s.a, s.d), opposite_d = turn * edge_plane(s.a, s.b);
    v.side_0 = pick(s.from, 0, opposite_a, opposite_b, opposite_d);
    v.side_1 = pick(s.from, 1, opposite_a, opposite_b, opposite_d);
    v.side_2 = pick(s.from, 2, opposite_a, opposite_b, opposite_d);
    v.cap = -sign(height) * ndc_plane(n, s.a) - cap_bias(height, from_point_to_light(s.a));
    // The planes that were negated leave themselves to the neighbour.
    const uvec3 open = turn > 0.0 ? uvec3(0, 1, 0) : uvec3(1, 0, 1);
    v.slot = (open.x << s.from.x | open.y << s.from.y | open.z << s.from.z) * VOLUME_OPEN;
    find_lines(s, v);
    v.primitive = 0;
    return v;
}

#endif
