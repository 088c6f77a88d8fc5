// SPDX-License-Identifier: Apache-2.0
#version 460

layout(set = 0, binding = 0) uniform sampler2D above;
layout(location = 0) out float below;

void main()
{
    below = 0.0;
    for (int i = 0; i < 4; ++i) below += texelFetch(above, 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1), 0).x;
}
