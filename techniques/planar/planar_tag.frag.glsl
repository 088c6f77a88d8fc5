// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/planar/planar.shared.h"

layout(set = 0, binding = 0) uniform usampler2D plane_image;
layout(set = 1, binding = 0, scalar) uniform Constants { TagConstants c; };

void main()
{
    if (texelFetch(plane_image, ivec2(gl_FragCoord.xy), 0).r != c.plane) discard;
}
