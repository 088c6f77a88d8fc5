// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/volume_outlines.shared.h"

layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 1, binding = 0, scalar) uniform Constants { VolumeOutlines c; };

layout(location = 0) out vec4 color;

void main()
{
    // Edges lie on surfaces: they count as seen up to a part in 500 behind one.
    const bool seen = gl_FragCoord.z * 1.002 >= texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
    const float alpha = seen ? c.opacity : c.hidden;
    color = vec4(c.color * alpha, alpha);
}
