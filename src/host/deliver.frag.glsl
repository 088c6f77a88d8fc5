// SPDX-License-Identifier: Apache-2.0
#version 460

layout(constant_id = 0) const bool grey = true;

layout(set = 0, binding = 0) uniform sampler2D shadow;
layout(location = 0) out vec4 color;

void main()
{
    const vec4 s = texelFetch(shadow, ivec2(gl_FragCoord.xy), 0);
    color = vec4(grey ? s.rrr : s.rgb, 1.0);
}
