// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_masked.glsl"
#include "techniques/occlusion_textures/occlusion_textures_content.glsl"

void main()
{
    if (!caster_is_there()) discard;
    leave_content();
}
