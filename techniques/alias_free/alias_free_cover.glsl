// SPDX-License-Identifier: Apache-2.0
// Conservative rasterisation without the extension: a triangle that covers the centres of all cells that a caster touches. More of
// them cost time, and change nothing, since every sample is tested exactly.

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

vec4 from_cells(vec2 q, GridLevel level, float z) { return vec4(q / float(level.side) * 2.0 - 1.0, z, 1.0); }

const vec4 nowhere = vec4(-2.0, -2.0, 0.0, 1.0);

// Of a triangle that reaches beside or behind the light: the box of its part further along the layer's axis than `behind`, where only
// what is within three times that of the light can be seen by any sample.
vec4 cover_clipped(vec4 h[3], GridLevel level, float behind, float grow, float z, uint corner)
{
    vec2 low = vec2(1e30), high = vec2(-1e30);
    for (int k = 0; k < 3; ++k) {
        const vec4 a = h[k], b = h[(k + 1) % 3];
        if (a.w >= behind) {
            low = min(low, a.xy / a.w);
            high = max(high, a.xy / a.w);
        }
        if ((a.w >= behind) != (b.w >= behind)) {
            const vec2 cut = mix(a.xy, b.xy, (behind - a.w) / (b.w - a.w)) / behind;
            low = min(low, cut);
            high = max(high, cut);
        }
    }
    const vec2 rim = vec2(grow + 4e-3 * level.scale), side = vec2(float(level.side));
    low = max(low * level.scale - rim, vec2(0.0));
    high = min(high * level.scale + rim, side);
    if (any(greaterThanEqual(low, high))) return nowhere;
    return from_cells(cover_box(low, high, vec2(1, 0), vec2(0, 1), corner), level, z);
}

// `height`: of the light above the triangle's plane.
vec4 covering_vertex(LightMapLayer layer, uint level_index, vec3 p[3], float height, uint corner)
{
    const GridLevel level = c.grid.level[level_index];
    const bool perspective = layer.perspective != 0;
    const float behind = perspective ? 1e-4 * layer.far : 0.0;
    vec4 h[3];
    float nearest = 1e30, furthest = -1e30, z = 0.0;
    vec3 extent = abs(perspective ? c.light.position : p[0]), low = p[0], high = p[0];
    for (int k = 0; k < 3; ++k) {
        h[k] = layer.map_from_world * vec4(p[k], 1.0);
        nearest = min(nearest, h[k].w);
        furthest = max(furthest, h[k].w);
        z = max(z, h[k].w > behind ? h[k].z / h[k].w : 1.0);
        extent = max(extent, abs(p[k]));
        low = min(low, p[k]);
        high = max(high, p[k]);
    }
    if (perspective && furthest <= 0.0) return nowhere;
    z = min(z, 1.0);
    const vec4 everywhere = vec4(corner == 1 ? 3.0 : -1.0, corner == 2 ? 3.0 : -1.0, z, 1.0);
    // the last level's one cell lists footprints of any extent
    if (SAMPLES > 1 && level_index + 1 == c.grid.levels) return everywhere;
    // Cells half a width each way, footprints as much again, 1/8 for the rasteriser's grid and the samples' rounding.
    float grow = SAMPLES > 1 ? 1.125 : 0.625;
    if (nearest <= behind) {
        const vec3 gap = max(max(low - c.light.position, c.light.position - high), vec3(0.0));
        if (height < 4.0 * behind && max(gap.x, max(gap.y, gap.z)) < 4.0 * behind) return everywhere;
        return cover_clipped(h, level, behind, grow, z, corner);
    }
    // and for the rounding of coordinates far outside of the map or from the world's origin
    vec2 q[3];
    float outside = 0.0;
    for (int k = 0; k < 3; ++k) {
        q[k] = h[k].xy / h[k].w * level.scale;
        outside = max(outside, max(abs(q[k].x), abs(q[k].y)));
    }
    const float width = layer.texel_metres * c.map.size * nearest; // w is 1 where the layer is orthographic
    grow += 1e-6 * (outside + max(extent.x, max(extent.y, extent.z)) / width * level.scale);
    return from_cells(cover_triangle(q, grow, corner), level, z);
}
