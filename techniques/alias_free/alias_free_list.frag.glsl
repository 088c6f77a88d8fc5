// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/alias_free/alias_free.glsl"

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1) uniform usampler2D normal_image;
layout(set = 0, binding = 2) uniform usampler2D primitive_image;
layout(set = 0, binding = 3) uniform usampler2D place_image;
layout(set = 0, binding = 4, scalar) readonly buffer Cells
{
    uint listed;
    uint used[8 * GRID_MAX_LEVELS];
    Cell cells[];
};
layout(set = 0, binding = 5, scalar) writeonly buffer Records { vec4 records[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer Blocked { uint blocked[]; };

void main()
{
    const uvec2 place = texelFetch(place_image, ivec2(gl_FragCoord.xy), 0).xy;
    if (place.x == NOWHERE) return;
    const ViewSample s = view_sample(depth_image, normal_image, gl_FragCoord.xy);
    const uint at = cells[place.x].first + place.y;
    const float primitive = uintBitsToFloat(texelFetch(primitive_image, ivec2(gl_FragCoord.xy), 0).x);
    // positions lie within half of u and v of the middle
    records[RECORD * at] = vec4(s.p, SAMPLES == 1 ? primitive : 0.5 * (length(s.u) + length(s.v)));
    if (SAMPLES > 1) {
        records[RECORD * at + 1] = vec4(s.u, primitive);
        records[RECORD * at + 2] = vec4(s.v, 0.0);
    }
    blocked[at] = s.blocked;
}
