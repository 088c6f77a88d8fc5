// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#define TEAM_IN_SHARED_MEMORY
#include "techniques/per_triangle_volumes/binary_traverse.glsl"

void main() { run(); }
