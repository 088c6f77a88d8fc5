// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/caster_blocks.shared.h"
#include "techniques/alias_free/alias_free_bindings.glsl"

layout(local_size_x = CASTER_BLOCK) in;

layout(set = 0, binding = 8, scalar) writeonly buffer Wide { WideCaster wide[]; };
layout(set = 0, binding = 9, scalar) buffer Draw { uint vertices, instance_count, first_vertex, first_instance; };
layout(set = 0, binding = 10, scalar) readonly buffer Blocks { CasterBlock caster_blocks[]; };
layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "techniques/alias_free/alias_free_caster.glsl"
#include "techniques/alias_free/alias_free_cover.glsl"
#include "techniques/alias_free/alias_free_triangle.glsl"

// Casters of few cells are tested here, where a triangle costs a third of its three vertices; the others are left to the rasteriser,
// which spreads one over many invocations. Where there is no room left for those they are tested here all the same.
const int narrow = 64;

void test_cells(Caster t, float z, uint base, uint side, ivec2 from, ivec2 to)
{
    for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x) {
            const uint cell = base + uint(y) * side + uint(x);
            if (is_open(cell, z)) test_cell(t, cell);
        }
}

void main()
{
    const uint block_index = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, layer_index = gl_WorkGroupID.z;
    if (block_index >= c.blocks) return;
    const CasterBlock block = caster_blocks[block_index];
    if (gl_LocalInvocationIndex >= block.count) return;
    const Instance i = instances[block.slot];
    const LightMapLayer layer = c.map.layers[layer_index];

    Caster t;
    t.triangle = block.first + gl_LocalInvocationIndex;
    t.slot = block.slot;
    t.primitive = i.first_primitive + t.triangle;
    t.masked = block.masked != 0;
    const vec3 p[3] = vec3[](corner_of(i, t.triangle, 0), corner_of(i, t.triangle, 1), corner_of(i, t.triangle, 2));
    float height;
    t.plane = light_side(p, height);
    if (t.plane == vec3(0.0)) return;
    const Seen s = see_triangle(layer, p, height);
    if (any(greaterThan(s.low, s.high))) return;
    edge_plane(p[1], p[2], t.normal_0, t.point_0);
    edge_plane(p[2], p[0], t.normal_1, t.point_1);
    edge_plane(p[0], p[1], t.normal_2, t.point_2);

    t.lengths = vec4(length(t.normal_0), length(t.normal_1), length(t.normal_2), length(t.plane));
    for (uint k = 0; k < c.grid.levels; ++k) {
        if (used[k * 8 + layer_index] == 0) continue;
        const GridLevel level = c.grid.level[k];
        // The last level's one cell lists footprints of any extent.
        const bool everywhere = SAMPLES > 1 && k + 1 == c.grid.levels;
        const float reach = reach_of(s, level), last = float(level.side - 1);
        const vec2 low = floor(s.low * level.scale - reach), high = floor(s.high * level.scale + reach);
        if (!everywhere && (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, vec2(last))))) continue;
        const ivec2 from = ivec2(clamp(low, vec2(0.0), vec2(last))), to = ivec2(clamp(high, vec2(0.0), vec2(last)));
        if ((to.x - from.x + 1) * (to.y - from.y + 1) > narrow) {
            const uint at = atomicAdd(vertices, 3) / 3;
            if (at < c.wide) {
                wide[at] = WideCaster(t.slot, t.triangle, block.masked, layer_index + 8 * k);
                continue;
            }
        }
        test_cells(t, s.z, layer_index * c.grid.cells + level.first, level.side, from, to);
    }
}
