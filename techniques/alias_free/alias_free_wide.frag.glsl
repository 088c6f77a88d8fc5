// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free_bindings.glsl"

layout(set = 2, binding = 0) uniform sampler2D textures[];

#include "shaders/alpha.glsl"
#include "techniques/alias_free/alias_free_caster.glsl"

layout(early_fragment_tests) in;

layout(location = 0) flat in vec3 edge_normal[3];
layout(location = 3) flat in vec3 edge_point[3];
layout(location = 6) flat in vec3 plane_normal;
layout(location = 7) flat in uvec4 ids; // layer + 8 level, slot, triangle, masked

void main()
{
    const GridLevel level = c.grid.level[ids.x >> 3u];
    const ivec2 xy = ivec2(gl_FragCoord.xy - level.corner);
    if (any(lessThan(gl_FragCoord.xy, level.corner)) || any(greaterThanEqual(xy, ivec2(level.side)))) return; // another level's cell
    const uint primitive = instances[ids.y].first_primitive + ids.z;
    const Caster t = Caster(edge_normal[0], edge_normal[1], edge_normal[2], edge_point[0], edge_point[1], edge_point[2], plane_normal,
        vec4(length(edge_normal[0]), length(edge_normal[1]), length(edge_normal[2]), length(plane_normal)), primitive, ids.y, ids.z, ids.w != 0);
    const uint cell = (ids.x & 7u) * c.grid.cells + level.first + uint(xy.y) * level.side + uint(xy.x);
    if (cells[cell].left != 0) test_cell(t, cell);
}
