// SPDX-License-Identifier: Apache-2.0
// Tests of a volume against boxes and samples. Every rounded operation here is monotonic in each operand and sums run in one order, so that
// what the corners of a box say holds, bit for bit, for each sample in it: the tree finds what a test of all samples would find.
#ifndef GNOMON_VOLUME_GLSL
#define GNOMON_VOLUME_GLSL
#include "techniques/per_triangle_volumes/per_triangle_volumes.shared.h"
#include "techniques/per_triangle_volumes/tree.glsl"

#define REJECT 0
#define REFINE 1
#define ACCEPT 2

// The least float above 0 that no device takes for 0.
const float LEAST = 1.17549435e-38;

float plane_value(vec4 plane, vec3 p)
{
    precise const float v = ((plane.x * p.x + plane.y * p.y) + plane.z * p.z) + plane.w;
    return v;
}

float most(vec4 plane, Box b)
{
    precise const float v = ((max(plane.x * b.x.x, plane.x * b.x.y) + max(plane.y * b.y.x, plane.y * b.y.y))
                                + max(plane.z * b.z.x, plane.z * b.z.y))
        + plane.w;
    return v;
}

float least(vec4 plane, Box b)
{
    precise const float v = ((min(plane.x * b.x.x, plane.x * b.x.y) + min(plane.y * b.y.x, plane.y * b.y.y))
                                + min(plane.z * b.z.x, plane.z * b.z.y))
        + plane.w;
    return v;
}

float most(vec3 line, Box b) { return max(line.x * b.x.x, line.x * b.x.y) + max(line.y * b.y.x, line.y * b.y.y) + line.z; }

// Values of the three sides from which a sample is inside. A sample on the plane of an edge belongs to one of the two triangles there.
vec3 side_limits(uint slot) { return mix(vec3(0.0), vec3(LEAST), notEqual(slot & (uvec3(1, 2, 4) * VOLUME_OPEN), uvec3(0))); }

int classify(Volume v, vec3 limits, Box b)
{
    if (most(v.line_0, b) < 0.0 || most(v.line_1, b) < 0.0 || most(v.line_2, b) < 0.0 || most(v.line_3, b) < 0.0) return REJECT;
    if (most(v.side_0, b) < limits.x || most(v.side_1, b) < limits.y || most(v.side_2, b) < limits.z || most(v.cap, b) < 0.0) return REJECT;
    const bool inside
        = least(v.side_0, b) >= limits.x && least(v.side_1, b) >= limits.y && least(v.side_2, b) >= limits.z && least(v.cap, b) >= 0.0;
    return inside ? ACCEPT : REFINE;
}

// `e`: the barycentric coordinates, but for their sum, of where the line from the light to p meets the triangle's plane.
bool is_inside(Volume v, vec3 limits, vec3 p, out vec3 e)
{
    e = vec3(plane_value(v.side_0, p), plane_value(v.side_1, p), plane_value(v.side_2, p));
    return all(greaterThanEqual(e, limits)) && plane_value(v.cap, p) >= 0.0;
}

#endif
