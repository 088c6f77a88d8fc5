// SPDX-License-Identifier: Apache-2.0
// A line of each quad as two triangles on the screen: its silhouette edge, or its side at the end where a closed loop of silhouettes, which
// all run one way around, has it once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_outlines.shared.h"
#include "src/shadow/parts/volume_sides.glsl"

layout(constant_id = 0) const bool sides = false;

layout(set = 0, binding = 0, scalar) readonly buffer Quads { VolumeQuad quads[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeOutlines c; };

void main()
{
    const VolumeQuad q = quads[gl_VertexIndex / 6];
    const uint corner = uint[](0, 1, 2, 2, 1, 3)[gl_VertexIndex % 6];
    const vec3 start = q.weight > 0 ? q.from : q.to;
    const vec3 end = sides ? start - c.reach * normalize(light_from(c.light, start)) : q.weight > 0 ? q.to : q.from;
    vec4 a = c.view.clip_from_world * vec4(start, 1.0), b = c.view.clip_from_world * vec4(end, 1.0);
    // by hand, since the line is widened after its division by w: z <= w is what lies beyond the near plane
    const float da = a.w - a.z, db = b.w - b.z;
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    if (da < 0.0 && db < 0.0) return;
    const vec4 cut = mix(a, b, da / (da - db == 0.0 ? 1.0 : da - db));
    if (da < 0.0) a = cut;
    if (db < 0.0) b = cut;
    const vec2 half_size = 0.5 * c.view.size, from = a.xy / a.w * half_size, to = b.xy / b.w * half_size;
    const vec2 along = (to - from) / max(length(to - from), 1e-6);
    // square ends: neighbouring edges meet without gaps
    const vec2 place = mix(from, to, corner >> 1) + c.half_width * (vec2(-along.y, along.x) * ((corner & 1) == 0 ? 1.0 : -1.0) + along * (corner < 2 ? -1.0 : 1.0));
    gl_Position = vec4(place / half_size, corner < 2 ? a.z / a.w : b.z / b.w, 1.0);
}
