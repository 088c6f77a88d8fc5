// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/hard_receiver.glsl"
#include "shaders/percentage_closer.glsl"
#include "techniques/virtual_shadow_map/virtual_shadow_map.shared.h"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform sampler2D wanted_image;
layout(set = 0, binding = 3) uniform sampler2DArray pool_image;
layout(set = 0, binding = 4, scalar) readonly buffer Table { uint table[]; };
layout(set = 0, binding = 5, scalar) readonly buffer CountsOf { Counts counts; };
layout(set = 1, binding = 0, scalar) uniform Constants { ResolveConstants c; };
#include "techniques/virtual_shadow_map/virtual_grid.glsl"

// Known to the compiler, so that the filter's loops are unrolled.
layout(constant_id = 0) const int pcf = 3;
layout(constant_id = 1) const bool bilinear = true;
layout(constant_id = 2) const int show = 0;
layout(constant_id = 3) const bool coned = true;

layout(location = 0) out float visibility;

void main()
{
    Receiver r;
    if (!find_hard_receiver(c.view, c.light, depth_image, normal_image, gl_FragCoord.xy, r, visibility)) {
        if (show >= VIRTUAL_INSPECT_PAGE) visibility = -1.0;
        return;
    }
    const int face = c.grid.layout_kind == LIGHT_MAP_CUBE ? select_cube_layer(c.grid.centre, mat3(1.0), r.p_world) : 0;
    const LightMapLayer layer = c.grid.face[face];
    MapPoint m = project(layer, r.p_world);
    const float wanted = texelFetch(wanted_image, ivec2(gl_FragCoord.xy), 0).r;
    const int level = max(level_for(wanted, m.uv) - int(counts.coarser), 0);
    if (show == VIRTUAL_SHOW_LEVEL) {
        visibility = float(level) / float(c.grid.levels);
        return;
    }
    if (show == VIRTUAL_SHOW_FOOTPRINT) { // 0.5 is the length asked for, and each 0.1 twice or half of that
        visibility = clamp(0.5 + 0.1 * (wanted - float(level)), 0.0, 1.0);
        return;
    }
    if (show == VIRTUAL_INSPECT_LEVEL) {
        visibility = float(level);
        return;
    }
    const ivec2 page = page_at(m.uv, level);
    const int slot = int(table[entry_of(face, level, page)]) - 1;
    if (show == VIRTUAL_INSPECT_PAGE) {
        visibility = float(slot);
        return;
    }

    // the page's texels are those of a map of this size
    const float size = float(c.grid.page << level);
    m.texel /= float(1 << level);
    m.depth -= c.params.bias_constant;
    const float radius = 0.5 * float(pcf) + 1.0;
    ReceiverPlane plane = coned ? cone_plane(layer, size, 0.0, m, r.p_world, r.n_geometric, c.params.bias_cone, c.params.slope_limit)
                                : receiver_plane(layer, size, 0.0, m, r.p_world, r.n_geometric, radius, c.params.slope_limit);
    // far from the axes' origin, coordinates round to more of a fine texel than the rasteriser's snapping does
    plane.z += (abs(plane.slope.x) + abs(plane.slope.y) + plane.cone) * size * max(abs(m.uv.x), abs(m.uv.y)) * 1.2e-7;
    plane.at -= first_texel(page, level) - float(c.grid.border);
    visibility = separable_filter(pool_image, slot, plane, pcf, false, bilinear ? RECONSTRUCT_BILINEAR : RECONSTRUCT_NEAREST, coned, false);
}
