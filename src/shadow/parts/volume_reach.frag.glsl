// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/ordered_float.glsl"
#include "src/shadow/parts/volume_mask.shared.h"

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0, scalar) readonly buffer Mask { uint everywhere; VolumeTexel texels[]; };
layout(location = 0) out float reach;

void main()
{
    const ivec2 at = ivec2(gl_FragCoord.xy);
    const uint ordered = texels[(layer * VOLUME_MASK_SIZE + at.y) * VOLUME_MASK_SIZE + at.x].reach;
    reach = ordered == 0u ? -3e38 : float_from_ordered(ordered);
}
