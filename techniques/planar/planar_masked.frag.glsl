// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "src/shadow/parts/light_masked.glsl"
#include "techniques/planar/planar.shared.h"

layout(set = 1, binding = 0, scalar) uniform Constants { CasterConstants c; };
layout(location = 0) out float kept;

void main()
{
    if (!caster_is_there()) discard;
    kept = c.kept;
}
