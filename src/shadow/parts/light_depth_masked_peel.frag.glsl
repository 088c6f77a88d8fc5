// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_depth_peel.glsl"
#include "src/shadow/parts/light_masked.glsl"

void main()
{
    if (!behind() || !caster_is_there()) discard;
}
