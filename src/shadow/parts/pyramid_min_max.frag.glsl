// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray above;
layout(location = 0) out vec2 min_max;

void main()
{
    // The last texel takes the odd one left over too, so that every level covers the image and texel i begins at 2^level i.
    const ivec2 size = textureSize(above, 0).xy, first = 2 * ivec2(gl_FragCoord.xy);
    const ivec2 left = size - first;
    const ivec2 count = ivec2(left.x == 3 ? 3 : min(left.x, 2), left.y == 3 ? 3 : min(left.y, 2));
    min_max = texelFetch(above, ivec3(first, layer), 0).xy;
    for (int j = 0; j < count.y; ++j)
        for (int i = j == 0 ? 1 : 0; i < count.x; ++i) {
            const vec2 next = texelFetch(above, ivec3(first + ivec2(i, j), layer), 0).xy;
            min_max = vec2(min(min_max.x, next.x), max(min_max.y, next.y));
        }
}
