// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/octahedral.glsl"
#include "shaders/receiver_plane.glsl"
#include "tests/gpu/percentage_closer.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { PlaneCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { PlaneResult results[]; };
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const LightMapLayer layer = cases[i].layer;
    const ReceiverPlane r = receiver_plane(layer, cases[i].size, 0.0, project(layer, cases[i].p_world), cases[i].p_world,
        decode_normal(encode_normal(cases[i].n)), cases[i].radius, cases[i].limit);
    results[i] = PlaneResult(r.at, r.z, r.slope, r.cone);
}
