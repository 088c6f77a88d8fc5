// SPDX-License-Identifier: Apache-2.0
// The light as the back projection meets it: on the plane through its centre that is parallel to the map.
#ifndef GNOMON_BACK_PROJECTION_LIGHT_GLSL
#define GNOMON_BACK_PROJECTION_LIGHT_GLSL
#include "shaders/frame.shared.h"
#include "shaders/light_map.shared.h"

// From a point l of that plane to the light's own coordinates, in which it is the square [-1, 1]^2 or its inscribed disk:
// x = scale.x l.x, y = scale.y l.y - shear x, after an exchange of l's axes where `turned`.
struct LightFrame {
    vec2 scale;
    float shear;
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
    return LightFrame(1.0 / vec2(a, c), b / c, false, sqrt(q.xz), vec2(1.0), false);
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
    return f;
}

// From the frame's square to coordinates along half_u and half_v.
vec2 along_sides(LightFrame f, vec2 p)
{
    p *= f.sign;
    return f.exchanged ? p.yx : p;
}

// The layer's axes in the world, along u, v and its depth: rows of the projection, without the part of perspective that centres it.
mat3 layer_axes(LightMapLayer layer)
{
    const vec3 depth = layer.depth_plane.xyz;
    const mat3 rows = transpose(mat3(layer.map_from_world));
    const float centring = layer.perspective != 0 ? 0.5 : 0.0;
    return mat3(normalize(rows[0] - centring * depth), normalize(rows[1] - centring * depth), depth);
}

// Axes: the map's, depth last; t: tangents of the receiver's direction. Where light and map are not parallel, the light is projected onto
// the plane along the ray through its centre, as a distant receiver sees it.
LightFrame light_frame(Light light, mat3 axes, vec2 t)
{
    const float r = light.radius;
    if (light.kind == LIGHT_DIRECTIONAL) return ellipse_frame(tan(r) * tan(r) * vec3(1.0, 0.0, 1.0));
    // a sphere is a disk across the ray: the projection lengthens it by 1 / cos along t
    if (light.kind == LIGHT_SPOT || light.kind == LIGHT_POINT) return ellipse_frame(r * r * vec3(1.0 + t.x * t.x, t.x * t.y, 1.0 + t.y * t.y));
    const vec3 u = light.half_u * axes, v = light.half_v * axes;
    const vec2 a = u.xy - u.z * t, b = v.xy - v.z * t;
    if (light.kind == LIGHT_RECT) return parallelogram_frame(a, b);
    return ellipse_frame(vec3(a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y));
}

#endif
