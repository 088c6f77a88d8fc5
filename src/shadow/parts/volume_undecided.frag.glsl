// SPDX-License-Identifier: Apache-2.0
#version 460

layout(set = 0, binding = 0) uniform sampler2D decided;

void main()
{
    if (texelFetch(decided, ivec2(gl_FragCoord.xy), 0).r >= 0.0) discard;
}
