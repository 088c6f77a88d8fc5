// SPDX-License-Identifier: Apache-2.0
// Which page each view sample needs: the coarsest whose texels are no longer than a pixel, seen from the eye (Lefohn et al. 2007).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/light_map.glsl"
#include "shaders/texel_footprint.glsl"
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, scalar) writeonly buffer Marks { uint marks[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { RequestConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"

layout(location = 0) out float wanted; // the level, between levels

void main()
{
    wanted = 0.0;
    Receiver r;
    float known;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, known)) return;
    const int face = c.grid.layout_kind == LIGHT_MAP_CUBE ? select_cube_layer(c.grid.centre, mat3(1.0), r.p_world) : 0;
    const LightMapLayer layer = c.grid.face[face];
    // a texel's longer side, of the coarsest level
    const float longer = longer_edge(texel_footprint(c.view, layer, float(c.grid.page), r.p_world, r.n_geometric).total);
    const float sine = dot(r.n_geometric, to_light(c.light, r.p_world).xyz);
    const float level = log2(min(1.0, sine / max(c.least_sine, 1e-6)) * longer / c.footprint);
    wanted = level > 0.0 ? min(level, 30.0) : 0.0; // also where it is not a number
    const vec2 uv = project(layer, r.p_world).uv;
    const int chosen = level_for(wanted, uv);
    const uint entry = entry_of(face, chosen, page_at(uv, chosen));
    marks[entry] = 1u;
    marks[run_mark(entry)] = 1u;
}
