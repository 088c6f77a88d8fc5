// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

// The depth of each cell's furthest sample, so that the depth test leaves out empty cells and casters that lie behind all samples.
layout(set = 0, binding = 0, scalar) readonly buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 1, binding = 0, scalar) uniform Constants { Grid grid; };

layout(location = 0) flat in int layer;

void main()
{
    uint level = 0;
    while (level + 1 < grid.levels && any(greaterThanEqual(gl_FragCoord.xy - grid.level[level].corner, vec2(float(grid.level[level].side))))) ++level;
    const GridLevel l = grid.level[level];
    const uvec2 xy = uvec2(gl_FragCoord.xy - l.corner);
    gl_FragDepth = 1.0;
    if (any(greaterThanEqual(gl_FragCoord.xy - l.corner, vec2(float(l.side)))) || any(lessThan(gl_FragCoord.xy, l.corner))) return;
    const uint code = cells[uint(layer) * grid.cells + l.first + xy.y * l.side + xy.x].furthest;
    if (code != 0) gl_FragDepth = reach_z(code);
}
