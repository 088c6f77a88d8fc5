// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "src/shadow/parts/light_depth_alpha.glsl"

void main()
{
    if (!alpha_kept()) discard;
}
