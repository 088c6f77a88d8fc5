// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/occlusion_textures/occlusion_textures_content.glsl"

void main() { leave_content(); }
