// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/light_map.glsl"
#include "techniques/blurred_depth/blurred_depth.shared.h"

// Mean depth in metres over `kernel` texels of a row, then of a column. Nothing there counts as the far plane.
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(set = 1, binding = 0, scalar) uniform Constants { BlurConstants c; };

layout(location = 0) out float metres;

void main()
{
    const ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(source, 0).xy - 1;
    const ivec2 along = c.vertical != 0 ? ivec2(0, 1) : ivec2(1, 0);
    float sum = 0.0;
    for (int i = 0; i < c.kernel; ++i) {
        const float v = fetch_depth(source, c.index, clamp(texel + (i - c.kernel / 2) * along, ivec2(0), last));
        sum += c.vertical != 0 ? v : depth_from_stored(c.layer, v);
    }
    metres = sum / float(c.kernel);
}
