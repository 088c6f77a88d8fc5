// SPDX-License-Identifier: Apache-2.0
// The view samples of one pixel, and where in the light's grid they are listed.
#ifndef GNOMON_ALIAS_FREE_GLSL
#define GNOMON_ALIAS_FREE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "shaders/light.glsl"
#include "shaders/light_map.glsl"
#include "shaders/receiver.glsl"
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { GridConstants c; };

// A pixel's positions p + a u + b v, with (a, b) = sub_pixel(i): its centre, or its footprint on the receiver's plane.
struct ViewSample {
    bool listed; // else the light does not reach it, or there is no receiver
    bool lit;
    vec3 p; // off its plane, where a ray towards the light would begin
    vec3 u, v;
    uint blocked; // bits of positions outside of a spot's cone, and of those that do not exist
};

ViewSample view_sample(sampler2D depth_image, usampler2D normal_image, vec2 pixel)
{
    ViewSample s;
    const Receiver r = load_receiver(c.view, depth_image, normal_image, pixel);
    s.lit = r.background;
    s.listed = !r.background && faces_light(c.light, r.p_world, r.n_geometric);
    const float error = position_rounding(c.view, r);
    s.p = r.p_world + error * (r.n_geometric + to_light(c.light, r.p_world).xyz);
    s.u = s.v = vec3(0.0);
    s.blocked = ~SAMPLE_BITS;
    if (SAMPLES > 1) {
        s.u = beside_on_plane(c.view, r.p_world, r.n_geometric, pixel, pixel + vec2(1, 0)) - r.p_world;
        s.v = beside_on_plane(c.view, r.p_world, r.n_geometric, pixel, pixel + vec2(0, 1)) - r.p_world;
    }
    if (c.light.kind == LIGHT_SPOT)
        for (int i = 0; i < SAMPLES; ++i) {
            const vec2 at = sub_pixel(i);
            if (!light_reaches(c.light, r.p_world + at.x * s.u + at.y * s.v)) s.blocked |= 1u << i;
        }
    s.listed = s.listed && s.blocked != 0xffffffffu;
    return s;
}

struct CellPlace {
    uint layer, level, cell;
    float z; // stored depth of the furthest position
};

CellPlace place_sample(ViewSample s)
{
    CellPlace at;
    at.layer = uint(select_layer(c.map.layout_kind, c.map.centre, c.map.axes, c.map.splits, s.p));
    const LightMapLayer layer = c.map.layers[at.layer];
    const vec4 h = layer.map_from_world * vec4(s.p, 1.0);
    const vec2 uv = h.xy / h.w;
    at.z = h.z / h.w;
    at.level = 0;
    if (SAMPLES > 1) {
        // Half the footprint's extent, in cells; what reaches beside the light's eye goes to the last level, which is one cell.
        const vec4 hu = layer.map_from_world * vec4(0.5 * s.u, 0.0), hv = layer.map_from_world * vec4(0.5 * s.v, 0.0);
        float extent = 0.0;
        for (int corner = 0; corner < 4; ++corner) {
            const vec4 q = h + ((corner & 1) != 0 ? hu : -hu) + ((corner & 2) != 0 ? hv : -hv);
            const vec2 d = abs(q.xy / q.w - uv);
            extent = q.w > 1e-3 * h.w ? max(extent, max(d.x, d.y)) : 1e30;
            at.z = min(at.z, q.w > 1e-3 * h.w ? q.z / q.w : 0.0);
            if (extent == 1e30) break;
        }
        while (at.level + 1 < c.grid.levels && !(extent * c.grid.level[at.level].scale <= FOOTPRINT_REACH)) ++at.level;
        if (at.level + 1 == c.grid.levels) at.z = 0.0;
    }
    const GridLevel level = c.grid.level[at.level];
    const uvec2 xy = uvec2(clamp(uv * level.scale, vec2(0.0), vec2(float(level.side - 1))));
    at.cell = at.layer * c.grid.cells + level.first + xy.y * level.side + xy.x;
    return at;
}

#endif
