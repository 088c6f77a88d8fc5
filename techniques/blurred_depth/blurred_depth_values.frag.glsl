// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/filter_values.glsl"

layout(set = 1, binding = 0, scalar) uniform Constants { FilterValues c; };
layout(location = 0) out float depth;

void main() { depth = stored_values(c, vec4(centred_depth(c, ivec2(gl_FragCoord.xy)))).x; }
