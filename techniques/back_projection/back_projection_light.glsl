// SPDX-License-Identifier: Apache-2.0
// The light as the back projection meets it: on the plane through its centre that is parallel to the map.
#ifndef GNOMON_BACK_PROJECTION_LIGHT_GLSL
#define GNOMON_BACK_PROJECTION_LIGHT_GLSL
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

// From a point l of that plane to the light's own coordinates, in which it is the square [-1, 1]^2 or its inscribed disk:
// x = scale.x l.x / (1 - bend l.x), y = scale.y l.y (1 - turn x) - shear x, after an exchange of l's axes where `turned`.
struct LightFrame {
    vec2 scale;
    float shear, bend, turn;
    bool turned;
    vec2 reach; // half the extent of the light's outline along the map's axes
    vec2 sign; // of a rectangle: x and y times this run along half_u and half_v,
    bool exchanged; // or along half_v and half_u
};

#define LEAST_WIDTH 1e-12

// The ellipse l^T Q^-1 l <= 1 (q: xx, xy, yy). Any root of Q takes it to the unit disk; the lower triangular one keeps columns upright.
LightFrame ellipse_frame(vec3 q)
{
    const float a = max(sqrt(q.x), LEAST_WIDTH), b = q.y / a, c = max(sqrt(max(q.z - b * b, 0.0)), LEAST_WIDTH);
    return LightFrame(1.0 / vec2(a, c), b / c, 0.0, 0.0, false, sqrt(q.xz), vec2(1.0), false);
}

// The parallelogram spanned by +-u and +-v, one of which lies along an axis of the map: cubes stand as their rectangles do.
LightFrame parallelogram_frame(vec2 u, vec2 v)
{
    LightFrame f;
    f.reach = abs(u) + abs(v);
    f.turned = min(abs(u.y), abs(v.y)) < min(abs(u.x), abs(v.x));
    if (f.turned) u = u.yx, v = v.yx;
    f.exchanged = abs(u.x) < abs(v.x);
    if (f.exchanged) {
        const vec2 w = u;
        u = v, v = w;
    }
    f.sign = vec2(u.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0);
    if (u.x < 0.0) u = -u;
    const vec2 width = max(vec2(u.x, abs(v.y)), LEAST_WIDTH);
    f.scale = 1.0 / width;
    f.shear = u.y / width.y;
    f.bend = f.turn = 0.0;
    return f;
}

// A rectangle, or the square around a disk, seen from a face of the cube that it stands across, one pair of its sides along the face's
// depth. n: its normal; half_depth, half_width: half its sides along that depth and across it; t: tangents of the receiver's direction;
// d: the receiver's depth. A point u along the depth and v across is seen from there at l_n = -u D / (d - u) and l_v = (d v - u P) / (d - u)
// on the plane through the centre, with D = d n.t its distance from the light and P = d t_v its place across. Inverse:
// u = -d l_n / (D - l_n), v = l_v (1 - u / d) + P u / d.
LightFrame upright_frame(vec2 n, float half_depth, float half_width, vec2 t, float d)
{
    LightFrame f;
    f.turned = abs(n.y) > abs(n.x);
    if (f.turned) n = n.yx, t = t.yx;
    const float side = n.x < 0.0 ? -1.0 : 1.0, slope = max(side * t.x, LEAST_WIDTH), part = half_depth / d;
    // x rises with l: it is -u where the light is seen from the positive side
    f.scale = 1.0 / max(vec2(slope * half_depth, half_width), LEAST_WIDTH);
    f.bend = side / (d * slope);
    f.turn = -side * part;
    f.shear = side * part * d * t.y * f.scale.y;
    const float rest = max(1.0 - part, 1e-3); // no receiver sees what is further along the depth than itself
    f.reach = vec2(slope * half_depth, half_width + part * d * abs(t.y)) / rest;
    if (f.turned) f.reach = f.reach.yx;
    f.sign = vec2(-side, 1.0);
    f.exchanged = false;
    return f;
}

// From the frame's square to coordinates along half_u and half_v.
vec2 along_sides(LightFrame f, vec2 p)
{
    p *= f.sign;
    return f.exchanged ? p.yx : p;
}

// The layer's axes in the world, along u, v and its depth: rows of the projection, without the part of perspective that puts the axis into
// its place.
mat3 layer_axes(LightMapLayer layer)
{
    const vec3 depth = layer.depth_plane.xyz;
    const mat3 rows = transpose(mat3(layer.map_from_world));
    return mat3(normalize(rows[0] - layer.axis_uv.x * depth), normalize(rows[1] - layer.axis_uv.y * depth), depth);
}

// Axes: the map's, depth last; t: tangents of the receiver's direction; d: its depth. A sphere is projected onto the plane along the ray
// through its centre, as a distant receiver sees it.
LightFrame light_frame(Light light, mat3 axes, vec2 t, float d)
{
    const float r = light.radius;
    if (light.kind == LIGHT_DIRECTIONAL) return ellipse_frame(tan(r) * tan(r) * vec3(1.0, 0.0, 1.0));
    // a sphere is a disk across the ray: the projection lengthens it by 1 / cos along t
    if (light.kind == LIGHT_SPOT || light.kind == LIGHT_POINT) return ellipse_frame(r * r * vec3(1.0 + t.x * t.x, t.x * t.y, 1.0 + t.y * t.y));
    const vec3 u = light.half_u * axes, v = light.half_v * axes, n = normalize(cross(u, v));
    if (abs(n.z) < 0.5) {
        const bool first = abs(u.z) > abs(v.z);
        // a disk's axes may lie anywhere in its plane
        if (light.kind == LIGHT_DISK) return upright_frame(n.xy, length(u), length(u), t, d);
        const vec3 along = first ? u : v, across = first ? v : u;
        LightFrame f = upright_frame(n.xy, length(along), length(across), t, d);
        if (along.z < 0.0) f.sign.x = -f.sign.x;
        if ((f.turned ? across.x : across.y) < 0.0) f.sign.y = -f.sign.y;
        f.exchanged = !first;
        return f;
    }
    if (light.kind == LIGHT_RECT) return parallelogram_frame(u.xy, v.xy);
    return ellipse_frame(vec3(u.x * u.x + v.x * v.x, u.x * u.y + v.x * v.y, u.y * u.y + v.y * v.y));
}

#endif
