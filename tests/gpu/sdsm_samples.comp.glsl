// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/sdsm_sample.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, scalar) writeonly buffer Out { vec4 samples[]; }; // w: NaN on the background
layout(set = 1, binding = 0, scalar) uniform Constants { SdsmReduce c; };

void main()
{
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = ivec2(c.view.size);
    if (any(greaterThanEqual(pixel, size))) return;
    const float depth = texelFetch(depth_image, pixel, 0).r;
    samples[pixel.y * size.x + pixel.x] = depth == 0.0 ? vec4(0, 0, 0, uintBitsToFloat(0x7fc00000u)) : sample_of(c, pixel, depth);
}
