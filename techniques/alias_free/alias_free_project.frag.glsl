// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2, scalar) buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};

layout(location = 0) out uvec2 place; // cell and place in its list; or NOWHERE and visibility

void main()
{
    const ViewSample s = view_sample(depth_image, normal_image, gl_FragCoord.xy);
    if (!s.listed) {
        place = uvec2(NOWHERE, s.lit ? 1 : 0);
        return;
    }
    const CellPlace at = place_sample(s);
    place = uvec2(at.cell, atomicAdd(cells[at.cell].count, 1));
    atomicMax(cells[at.cell].furthest, furthest_code(at.z));
    atomicOr(used[at.level * 8 + at.layer], 1);
}
