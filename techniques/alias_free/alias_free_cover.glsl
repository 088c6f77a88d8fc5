// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ALIAS_FREE_COVER_GLSL
#define GNOMON_ALIAS_FREE_COVER_GLSL

// Conservative rasterisation without the extension: a triangle that covers the centres of all cells that a caster touches. More of
// them cost time, and change nothing, since every sample is tested exactly.

const vec4 nowhere = vec4(-2.0, -2.0, 0.0, 1.0);

// Three corners around the box from `low` to `high` in axes x, y (orthonormal).
vec2 cover_box(vec2 low, vec2 high, vec2 x, vec2 y, uint corner)
{
    const vec2 at = vec2(corner == 1 ? 2.0 * high.x - low.x : low.x, corner == 2 ? 2.0 * high.y - low.y : low.y);
    return at.x * x + at.y * y;
}

// Each edge moved outwards until a square of half width `grow`, centred on it, lies inside (Hasselgren, Akenine-Moller, Ohlsson 2005).
// Where two edges meet at a sharp angle that corner would lie far out, and a box along the longest edge takes its place.
vec2 cover_triangle(vec2 q[3], float grow, uint corner)
{
    vec2 t[3];
    float least_turn = 1.0, longest = 0.0;
    vec2 x = vec2(1, 0);
    for (int k = 0; k < 3; ++k) {
        const vec2 e = q[(k + 1) % 3] - q[k];
        const float l = length(e);
        t[k] = e / max(l, 1e-20);
        if (l > longest) {
            longest = l;
            x = t[k];
        }
    }
    for (int k = 0; k < 3; ++k) least_turn = min(least_turn, abs(t[k].x * t[(k + 1) % 3].y - t[k].y * t[(k + 1) % 3].x));
    if (least_turn < 0.25 || longest < 1e-4) {
        const vec2 y = vec2(-x.y, x.x);
        vec2 low = vec2(1e30), high = vec2(-1e30);
        for (int k = 0; k < 3; ++k) {
            const vec2 a = vec2(dot(q[k], x), dot(q[k], y));
            low = min(low, a);
            high = max(high, a);
        }
        const float g = grow * (abs(x.x) + abs(x.y));
        return cover_box(low - g, high + g, x, y, corner);
    }
    // the corner between edge `into` and the one after it: dot(n, d) = offset for both, solved for d
    const vec2 into = t[(corner + 2) % 3], from = t[corner];
    const float turn = into.x * from.y - into.y * from.x, side = turn < 0.0 ? 1.0 : -1.0;
    const vec2 n = side * vec2(-into.y, into.x), m = side * vec2(-from.y, from.x);
    const vec2 offset = grow * vec2(abs(n.x) + abs(n.y), abs(m.x) + abs(m.y));
    const float det = n.x * m.y - n.y * m.x;
    return q[corner] + vec2(offset.x * m.y - offset.y * n.y, offset.y * n.x - offset.x * m.x) / det;
}

// Where the light sees a triangle, in cells of one level.
struct Seen {
    vec2 q0, q1, q2; // its corners, where it is `whole`
    bool whole; // all of it lies before the light's eye
    vec2 low, high; // a box around it
    float z; // stored depth of its nearest corner
    float rounding; // of all these coordinates
};

// Of a triangle that reaches beside or behind the light: the box of its part further along the layer's axis than `behind`. What is
// nearer can be seen by a sample only within three times that of the light, and then it may be seen anywhere.
void see_clipped(inout Seen s, vec4 h[3], vec3 p[3], float height, float behind)
{
    s.low = vec2(1e30);
    s.high = vec2(-1e30);
    for (int k = 0; k < 3; ++k) {
        const vec4 a = h[k], b = h[(k + 1) % 3];
        if (a.w >= behind) {
            s.low = min(s.low, a.xy / a.w);
            s.high = max(s.high, a.xy / a.w);
        }
        if ((a.w >= behind) != (b.w >= behind)) {
            const vec2 cut = mix(a.xy, b.xy, (behind - a.w) / (b.w - a.w)) / behind;
            s.low = min(s.low, cut);
            s.high = max(s.high, cut);
        }
    }
    s.rounding = 4e-3;
    const vec3 gap = max(max(min(p[0], min(p[1], p[2])) - c.light.position, c.light.position - max(p[0], max(p[1], p[2]))), vec3(0.0));
    if (height < 4.0 * behind && max(gap.x, max(gap.y, gap.z)) < 4.0 * behind) {
        s.low = vec2(0.0);
        s.high = vec2(1.0);
    }
}

// In units of the map's width. `height`: of the light above the triangle's plane.
Seen see_triangle(LightMapLayer layer, vec3 p[3], float height)
{
    Seen s;
    const bool perspective = layer.perspective != 0;
    const float behind = perspective ? 1e-4 * layer.far : 0.0;
    const vec4 h[3] = vec4[](layer.map_from_world * vec4(p[0], 1.0), layer.map_from_world * vec4(p[1], 1.0), layer.map_from_world * vec4(p[2], 1.0));
    s.z = 0.0;
    for (int k = 0; k < 3; ++k) s.z = max(s.z, h[k].w > behind ? h[k].z / h[k].w : 1.0);
    s.z = min(s.z, 1.0);
    const float nearest = min(h[0].w, min(h[1].w, h[2].w));
    s.whole = nearest > behind;
    s.q0 = s.q1 = s.q2 = vec2(0.0);
    if (!s.whole) {
        see_clipped(s, h, p, height, behind);
        return s;
    }
    s.q0 = h[0].xy / h[0].w;
    s.q1 = h[1].xy / h[1].w;
    s.q2 = h[2].xy / h[2].w;
    s.low = min(s.q0, min(s.q1, s.q2));
    s.high = max(s.q0, max(s.q1, s.q2));
    // of coordinates far outside of the map, and far from the world's origin
    const vec3 extent = max(max(abs(p[0]), abs(p[1])), max(abs(p[2]), perspective ? abs(c.light.position) : vec3(0.0)));
    const float width = layer.texel_metres * c.map.size * nearest; // w is 1 where the layer is orthographic
    const vec2 outside = max(abs(s.low), abs(s.high));
    s.rounding = 1e-6 * (max(outside.x, outside.y) + max(extent.x, max(extent.y, extent.z)) / width);
    return s;
}

// How far, in cells, a triangle may lie from the cell of a sample that it darkens: a footprint is listed in its middle's cell.
float reach_of(Seen s, GridLevel level) { return (SAMPLES > 1 ? FOOTPRINT_REACH : 0.0) + 0.02 + s.rounding * level.scale; }

vec4 covering_vertex(LightMapLayer layer, GridLevel level, vec3 p[3], float height, uint corner)
{
    const Seen s = see_triangle(layer, p, height);
    // half a cell and the rasteriser's grid more: a fragment is where a cell's centre is covered
    const float grow = 0.55 + reach_of(s, level);
    vec2 at;
    if (s.whole) {
        at = cover_triangle(vec2[](s.q0 * level.scale, s.q1 * level.scale, s.q2 * level.scale), grow, corner);
    } else {
        const vec2 side = vec2(float(level.side));
        const vec2 low = clamp(s.low * level.scale - grow, vec2(0.0), side), high = clamp(s.high * level.scale + grow, vec2(0.0), side);
        at = cover_box(low, high, vec2(1, 0), vec2(0, 1), corner);
    }
    return vec4((level.corner + at) / c.grid.image * 2.0 - 1.0, s.z, 1.0);
}

#endif
