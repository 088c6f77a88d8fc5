// SPDX-License-Identifier: Apache-2.0
#version 460

layout(location = 0) flat in int layer;
layout(set = 0, binding = 0) uniform sampler2DArray above;
layout(location = 0) out vec4 mean;

// Of n = 2 m + 1 texels, texel i of m is the mean over 2 + 1/m of them: the parts of texels 2 i, 2 i + 1, 2 i + 2 (Guthe and Heckbert 2005,
// "Non-power-of-two mipmapping"). Of an even number, the mean of two; of one, itself.
vec3 parts(int i, int n)
{
    if (n == 1) return vec3(1.0, 0.0, 0.0);
    const int m = n / 2;
    return (n & 1) == 0 ? vec3(0.5, 0.5, 0.0) : vec3(m - i, m, i + 1) / float(n);
}

void main()
{
    const ivec2 size = textureSize(above, 0).xy, at = ivec2(gl_FragCoord.xy);
    const vec3 x = parts(at.x, size.x), y = parts(at.y, size.y);
    const int columns = size.x == 1 ? 1 : 2 + (size.x & 1), rows = size.y == 1 ? 1 : 2 + (size.y & 1);
    mean = vec4(0.0);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) mean += x[i] * y[j] * texelFetch(above, ivec3(2 * at + ivec2(i, j), layer), 0);
}
