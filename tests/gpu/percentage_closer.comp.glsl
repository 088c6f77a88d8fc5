// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/percentage_closer.glsl"
#include "tests/gpu/percentage_closer.shared.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer In { FilterCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Out { float results[]; };
layout(set = 0, binding = 2) uniform sampler2DArray map;
layout(set = 0, binding = 3) uniform sampler2DArrayShadow hardware_map;
layout(set = 1, binding = 0, scalar) uniform Constants { uint count; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    const FilterCase k = cases[i];
    const ReceiverPlane r = ReceiverPlane(k.at, k.z, k.slope, k.cone, vec2(0.0));
    const vec2 texel = 1.0 / vec2(textureSize(map, 0).xy);
    if (k.kind == CASE_SEPARABLE)
        results[i] = separable_filter(map, 0, r, k.n, k.gaussian != 0, k.reconstruct, k.cone != 0.0, k.adaptive != 0);
    else if (k.kind == CASE_TAP)
        results[i] = compare_tap(map, 0, r, k.d, texel, k.reconstruct != 0, k.cone != 0.0);
    else if (k.kind == CASE_HARDWARE_TAP)
        results[i] = compare_depth(hardware_map, 0, (k.at + k.d) * texel, k.z);
    else
        results[i] = box_filter(hardware_map, 0, k.at, k.z, k.n, k.reconstruct != 0);
}
