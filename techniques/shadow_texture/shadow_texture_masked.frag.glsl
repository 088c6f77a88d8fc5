// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_masked.glsl"

layout(location = 0) out float lit;

void main()
{
    if (!caster_is_there()) discard;
    lit = 0.0;
}
