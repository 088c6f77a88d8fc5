// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free.shared.h"
#include "techniques/alias_free/alias_free_cells.glsl"

layout(set = 0, binding = 0) uniform usampler2D place_image;
layout(set = 0, binding = 1, scalar) readonly buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 2, scalar) readonly buffer Blocked { uint blocked[]; };

layout(location = 0) out float visibility;

void main()
{
    const uvec2 place = texelFetch(place_image, ivec2(gl_FragCoord.xy), 0).xy;
    visibility = float(place.y);
    if (place.x != NOWHERE) visibility = float(bitCount(~blocked[cells[place.x].first + place.y])) / float(SAMPLES);
}
