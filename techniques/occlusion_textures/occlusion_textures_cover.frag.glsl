// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures_cover.glsl"

layout(location = 0) flat in int layer;
layout(location = 0) out vec4 covered;

void main() { covered = vec4(covers(ivec2(gl_FragCoord.xy), layer / c.layers, layer % c.layers)); }
