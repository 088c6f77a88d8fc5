// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require
#include "src/shadow/parts/light_depth_alpha.glsl"
#include "src/shadow/parts/light_depth_peel.glsl"

void main()
{
    if (!behind() || !alpha_kept()) discard;
}
