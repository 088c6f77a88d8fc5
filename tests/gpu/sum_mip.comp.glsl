// SPDX-License-Identifier: Apache-2.0
#version 460

// One mip from the one above: the sum of its four texels.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D above;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D below;

void main()
{
    const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, imageSize(below)))) return;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += texelFetch(above, 2 * p + ivec2(i & 1, i >> 1), 0).x;
    imageStore(below, p, vec4(sum));
}
